#include <cmath>
#include <cstdint>
#include <string>
#include <utility>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

aeolian_msgs::WindStatistics to_message(const WindField& wind, const std_msgs::Header& header) {
  aeolian_msgs::WindStatistics message;
  message.header = header;
  message.model = wind.model;
  message.age = wind.age;
  message.friction_velocity = wind.friction_velocity;
  message.direction = wind.direction;
  message.air_density = wind.air_density;
  return message;
}

aeolian_msgs::AnemometerStatistics to_message(const GustStatistics& statistics) {
  aeolian_msgs::AnemometerStatistics message;
  message.duration = statistics.duration;
  message.readings = static_cast<std::uint32_t>(statistics.readings);
  message.speed = statistics.speed;
  message.direction = statistics.direction;
  message.deviation_along = statistics.deviation_along;
  message.deviation_across = statistics.deviation_across;
  message.turbulence_intensity = statistics.turbulence_intensity;
  message.gust = statistics.gust;
  message.gust_ratio = statistics.gust_ratio;
  return message;
}

aeolian_msgs::WindAtPoints to_message(const std::vector<ProbeReading>& readings,
                                      const std::vector<Eigen::Vector3d>& points,
                                      const std_msgs::Header& header) {
  if (readings.size() != points.size())
    throw Error("wind at points: there are " + std::to_string(readings.size()) + " readings for " +
                std::to_string(points.size()) + " points");
  aeolian_msgs::WindAtPoints message;
  message.header = header;
  for (std::size_t i = 0; i < points.size(); ++i) {
    geometry_msgs::Point& point = message.points.emplace_back();
    point.x = points[i].x();
    point.y = points[i].y();
    point.z = points[i].z();
    const ProbeReading& reading = readings[i];
    geometry_msgs::Vector3& velocity = message.velocity.emplace_back();
    velocity.x = reading.mean.east;
    velocity.y = reading.mean.north;
    velocity.z = reading.mean.up;
    message.friction_velocity.push_back(reading.friction_velocity);
    message.turbulence_intensity.push_back(std::isfinite(reading.intensity) ? reading.intensity : NAN);
    message.separated.push_back(reading.separated ? 1 : 0);
  }
  return message;
}

aeolian_msgs::GustRecord to_message(const Gusts& gusts) {
  aeolian_msgs::GustRecord message;
  message.step = gusts.step;
  message.along = gusts.along;
  message.across = gusts.across;
  message.up = gusts.up;
  GustSpectrum spectrum = gust_spectrum(gusts.along, gusts.step);
  message.frequency = std::move(spectrum.frequency);
  message.density_along = std::move(spectrum.density);
  message.density_across = gust_spectrum(gusts.across, gusts.step).density;
  message.density_up = gust_spectrum(gusts.up, gusts.step).density;
  return message;
}

}  // namespace aeolian
