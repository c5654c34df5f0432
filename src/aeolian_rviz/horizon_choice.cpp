#include "aeolian_rviz/horizon_choice.hpp"

#include <cmath>
#include <ctime>

#include <fmt/format.h>

#include "aeolian_twin/nodes/lead_time_words.hpp"

namespace aeolian {
namespace {

/// A clock that shows less than a year since 1970 counts from something else.
constexpr std::uint32_t one_year = 365 * 86400;

std::string time_words(const ros::Time& time) {
  if (time.sec < one_year) return fmt::format("{:.1f} s", time.toSec());
  const auto seconds = static_cast<std::time_t>(std::llround(time.toSec()));
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  return fmt::format("{:02}:{:02}:{:02} UTC", parts.tm_hour, parts.tm_min, parts.tm_sec);
}

}  // namespace

int HorizonChoice::chosen() const {
  int nearest = 0;
  for (int position = 1; position <= last(); ++position)
    if (std::abs(lead_time(position) - horizons_.chosen) < std::abs(lead_time(nearest) - horizons_.chosen))
      nearest = position;
  return nearest;
}

double HorizonChoice::lead_time(int position) const {
  return position <= 0 || position > last() ? 0
                                            : horizons_.lead_times[static_cast<std::size_t>(position - 1)];
}

std::string HorizonChoice::mark(int position) const { return lead_time_words(lead_time(position)); }

std::string HorizonChoice::title(int position) const {
  if (last() == 0) return "No forecast yet";
  return position <= 0 ? "Measured now" : fmt::format("Predicted {} ahead", mark(position));
}

std::string HorizonChoice::times(int position) const {
  const auto at = static_cast<std::size_t>(position - 1);
  if (position <= 0 || at >= horizons_.valid.size()) return "";
  const ros::Time valid = horizons_.valid[at];
  return fmt::format("for {}, from the surface at {}", time_words(valid),
                     time_words(valid - ros::Duration(lead_time(position))));
}

}  // namespace aeolian
