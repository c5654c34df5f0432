#include "aeolian_twin/nodes/wind_words.hpp"

#include <fmt/format.h>

namespace aeolian {

void tell_of_wind(const ForecastEngine::Taken& taken, const ForecastEngine::Settings& settings,
                  const ros::Time& stamp, const Tell& tell) {
  if (taken.without_wind)
    tell("wind", false,
         fmt::format("no wind in the {} s before the map at {}.{:09}: no forecast", settings.wind.window,
                     stamp.sec, stamp.nsec));
  if (!taken.job) return;
  const WindSpell& first = taken.job->wind.front();
  if (taken.bridged_gap)
    tell("wind", false,
         fmt::format("a gap of {:.1f} s in the wind is bridged with the mean of the rest",
                     *taken.bridged_gap));
  else if (!first.ahead)
    tell("wind", true,
         fmt::format("{} readings in the last {} s", first.samples.size(), settings.wind.window));
  if (taken.not_given_ahead)
    tell("wind ahead", false,
         fmt::format("is late or too short: {:.0f} s of {:.0f} are not given and are bridged "
                     "with the wind so far",
                     *taken.not_given_ahead, settings.horizons.back()));
  else if (first.ahead)
    tell("wind ahead", true, "in use");
}

}  // namespace aeolian
