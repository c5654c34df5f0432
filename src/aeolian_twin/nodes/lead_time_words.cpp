#include "aeolian_twin/nodes/lead_time_words.hpp"

#include <cmath>

#include <fmt/format.h>

namespace aeolian {
namespace {

std::string in_two(long long parts, long long per_whole, const char* whole, const char* part) {
  const long long rest = parts % per_whole;
  std::string words = fmt::format("{} {}", parts / per_whole, whole);
  if (rest != 0) words += fmt::format(" {} {}", rest, part);
  return words;
}

}  // namespace

std::string lead_time_words(double seconds) {
  if (seconds == 0) return "now";
  if (seconds < 9.95 && seconds != std::round(seconds)) return fmt::format("{:.1f} s", seconds);
  const long long whole = std::llround(seconds);
  if (whole < 120 && whole != 60) return fmt::format("{} s", whole);
  if (whole < 3600) return in_two(whole, 60, "min", "s");
  return in_two(std::llround(seconds / 60), 60, "h", "min");
}

}  // namespace aeolian
