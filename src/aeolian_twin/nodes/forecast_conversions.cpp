#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

std::vector<WindSample> to_wind_samples(const aeolian_msgs::WindAhead& message, double roughness) {
  const std::size_t count = message.lead_time.size();
  if (message.speed.size() != count || message.direction.size() != count)
    throw Error(fmt::format("wind ahead: {} lead times, {} speeds and {} directions, must be as many", count,
                            message.speed.size(), message.direction.size()));
  std::vector<WindSample> samples;
  for (std::size_t i = 0; i < count; ++i) {
    WindSample sample;
    sample.time = message.header.stamp.toSec() + message.lead_time[i];
    sample.friction_velocity = friction_velocity(message.speed[i], message.height, roughness);
    sample.direction = message.direction[i];
    if (message.air_density != 0) sample.air_density = message.air_density;
    samples.push_back(sample);
  }
  return samples;
}

aeolian_msgs::LearnedParameters to_message(const LearnedState& state, const ParameterLearner::Update& update,
                                           bool in_use, const std_msgs::Header& header) {
  aeolian_msgs::LearnedParameters message;
  message.header = header;
  const auto median = update.after.values();
  const auto members = static_cast<double>(state.members.size());
  for (std::size_t i = 0; i < UncertainParameters::count; ++i) {
    double sum = 0;
    double square = 0;
    for (const UncertainParameters& member : state.members) {
      const double off = std::log(member.values()[i] / median[i]);
      sum += off;
      square += off * off;
    }
    message.names.push_back(UncertainParameters::names()[i]);
    message.median.push_back(median[i]);
    message.sigma.push_back(std::sqrt(std::max(0.0, square - sum * sum / members) / (members - 1)));
  }
  message.updates = static_cast<std::uint32_t>(state.updates);
  message.learned = update.learned;
  message.why_not = update.why_not;
  message.in_use = in_use;
  message.innovation = update.innovation;
  return message;
}

}  // namespace aeolian
