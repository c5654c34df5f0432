#include "aeolian_core/twin/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace aeolian {
namespace {

const std::string minus = "\u2212";

std::string fixed(double value, int decimals) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", decimals, std::abs(value));
  const std::string digits = buffer;
  const bool zero = digits.find_first_not_of("0.") == std::string::npos;
  return value < 0 && !zero ? minus + digits : digits;
}

}  // namespace

Unit length_unit(double largest) {
  if (std::abs(largest) < 0.05) return {1e3, "mm"};
  if (std::abs(largest) < 1) return {1e2, "cm"};
  return {1, "m"};
}

Unit volume_unit(double largest) {
  if (std::abs(largest) < 1e-3) return {1e6, "cm³"};
  if (std::abs(largest) < 1) return {1e3, "litres"};
  return {1, "m³"};
}

Unit time_unit(double largest) {
  if (largest < 120) return {1, "s"};
  if (largest < 3 * 3600) return {1.0 / 60, "min"};
  return {1.0 / 3600, "h"};
}

std::string number_text(double value) {
  if (std::isnan(value)) return "not available";
  if (std::isinf(value)) return value < 0 ? minus + "∞" : "∞";
  if (value == 0) return "0";
  const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
  return fixed(value, std::clamp(2 - magnitude, 0, 3));
}

std::string quantity_text(double value, const Unit& unit) {
  const std::string number = number_text(value * unit.factor);
  return std::isfinite(value) ? number + " " + unit.name : number;
}

std::string length_text(double metres) { return quantity_text(metres, length_unit(metres)); }

std::string skill_text(double skill) {
  if (!std::isfinite(skill)) return number_text(skill);
  const std::string digits = fixed(skill, 2);
  return skill > 0 && digits != "0.00" ? "+" + digits : digits;
}

std::string duration_text(double seconds) {
  if (!std::isfinite(seconds)) return number_text(seconds);
  if (seconds < 10) return number_text(seconds) + " s";
  const auto whole = static_cast<long long>(std::llround(seconds));
  const auto part = [](long long count, const char* unit) {
    return count > 0 ? " " + std::to_string(count) + " " + unit : std::string();
  };
  if (whole < 60) return std::to_string(whole) + " s";
  const std::string text = whole < 3600 ? part(whole / 60, "min") + part(whole % 60, "s")
                                        : part(whole / 3600, "h") + part(whole % 3600 / 60, "min");
  return text.substr(1);
}

std::string escape_html(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else
      result += c;
  }
  return result;
}

}  // namespace aeolian
