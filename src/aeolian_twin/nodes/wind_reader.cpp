#include "aeolian_twin/nodes/wind_reader.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

WindReader::WindReader(const Parameters& parameters, const std::string& topic,
                       const tf2::BufferCore& transforms, Tell tell)
    : topic_(topic),
      transforms_(transforms),
      tell_(std::move(tell)),
      frame_(parameters.text("frame_id")),
      anemometer_height_(parameters.number("anemometer_height")),
      air_density_(parameters.number("air_density")),
      max_speed_(parameters.number("max_speed")),
      max_gap_(parameters.number("max_gap")) {
  const double roughness = parameters.number("roughness");
  model_ = std::make_unique<LogLawWind>(roughness > 0 ? roughness
                                                      : grain_roughness(parameters.number("grain_diameter")));
}

void WindReader::take_map(const grid_map_msgs::GridMap& message) {
  map_ = to_height_map(message);
  double sum = 0;
  const HeightMap::Layer& elevation = map_.layer(layer::elevation);
  for (const float z : elevation)
    if (std::isfinite(z)) sum += static_cast<double>(z);
  const std::size_t known = count_known(elevation);
  ground_ = known > 0 ? sum / static_cast<double>(known) : 0;
}

std::optional<grid_map_msgs::GridMap> WindReader::take_wind(const geometry_msgs::TwistStamped& message) {
  notice_time(message.header.stamp);
  try {
    const WindField wind = solve(message);
    std_msgs::Header header;
    header.frame_id = frame_;
    header.stamp = message.header.stamp;
    const GridGeometry one_cell(-0.5, -0.5, 1, 1, 1);
    return to_message(wind, map_.geometry().size() > 0 ? map_.geometry() : one_cell, header);
  } catch (const Error& error) {
    tell_("wind", false, error.what());
    return std::nullopt;
  }
}

WindField WindReader::solve(const geometry_msgs::TwistStamped& message) {
  Eigen::Vector3d velocity(message.twist.linear.x, message.twist.linear.y, 0);
  if (!velocity.allFinite() || velocity.norm() > max_speed_)
    throw Error(
        fmt::format("{}: velocity is ({}, {}) m/s, must be finite and at most {} m/s (~max_speed); skipped",
                    topic_, velocity.x(), velocity.y(), max_speed_));
  WindInput input;
  input.height = anemometer_height_;
  if (const std::optional<Eigen::Isometry3d> mast = anemometer_pose(message.header)) {
    velocity = mast->linear() * velocity;
    input.height = mast->translation().z() - ground_;
  }
  input.speed = velocity.head<2>().norm();
  input.direction = std::atan2(velocity.y(), velocity.x());
  input.air_density = air_density_;
  const bool has_map = map_.geometry().size() > 0;
  WindField wind = model_->solve(input, has_map ? &map_ : nullptr);
  tell_("wind", true,
        fmt::format("{:.2f} m/s at {:.2f} m over the ground gives a friction velocity of {:.3f} m/s",
                    input.speed, input.height, wind.friction_velocity));
  return wind;
}

/// Where the anemometer stands; nothing when tf does not know, then its parameters hold.
std::optional<Eigen::Isometry3d> WindReader::anemometer_pose(const std_msgs::Header& header) const {
  if (header.frame_id.empty() || header.frame_id == frame_) return std::nullopt;
  if (!transforms_.canTransform(frame_, header.frame_id, ros::Time(0))) return std::nullopt;
  return tf2::transformToEigen(transforms_.lookupTransform(frame_, header.frame_id, ros::Time(0)));
}

void WindReader::notice_time(const ros::Time& stamp) {
  const double step = last_stamp_.isZero() ? 0 : (stamp - last_stamp_).toSec();
  if (step < 0)
    tell_("clock", false, fmt::format("time jumped back by {:.1f} s (a bag that loops?)", -step));
  else if (step > max_gap_)
    tell_("clock", false,
          fmt::format("the wind record has a gap of {:.1f} s, more than ~max_gap = {} s", step, max_gap_));
  else
    tell_("clock", true, "no gaps");
  last_stamp_ = stamp;
}

}  // namespace aeolian
