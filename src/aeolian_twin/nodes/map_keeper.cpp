#include "aeolian_twin/nodes/map_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "aeolian_core/measure/bed_frame.hpp"
#include "aeolian_core/measure/registration.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"

namespace aeolian {
namespace {

FusionParameters read_fusion(const Parameters& parameters, const SensorNoise& sensor) {
  FusionParameters fusion;
  fusion.sensor = sensor;
  fusion.change.rate_sigma = parameters.number("rate_sigma");
  fusion.change.rate_time = parameters.number("rate_time");
  fusion.robust = parameters.flag("robust");
  fusion.gate_sigma = parameters.number("gate_sigma");
  fusion.gate_patience = parameters.integer("gate_patience");
  return fusion;
}

std::optional<GridGeometry> read_grid(const Parameters& parameters) {
  const double length_x = parameters.number("length_x");
  const double length_y = parameters.number("length_y");
  if ((length_x > 0) != (length_y > 0))
    parameters.refuse("length_y", "positive together with length_x, or 0 with it");
  if (length_x == 0) return std::nullopt;
  const double x = parameters.number("min_x");
  const double y = parameters.number("min_y");
  return GridGeometry::covering(x, y, x + length_x, y + length_y, parameters.number("cell_size"));
}

LiveMap::Settings read_settings(const Parameters& parameters, const SensorNoise& sensor) {
  LiveMap::Settings settings;
  settings.fusion = read_fusion(parameters, sensor);
  const std::string& frame = parameters.text("frame_id");
  const bool level = parameters.flag("level");
  settings.frame = level ? parameters.text("bed_frame") : frame;
  if (level && settings.frame == frame) parameters.refuse("bed_frame", "another than frame_id");
  settings.cell_size = parameters.number("cell_size");
  settings.max_cells = parameters.number("max_cells");
  settings.geometry = read_grid(parameters);
  return settings;
}

}  // namespace

MapKeeper::MapKeeper(const Parameters& parameters, const SensorNoise& sensor, Tell tell, BedFound bed_found)
    : tell_(std::move(tell)),
      bed_found_(std::move(bed_found)),
      level_(parameters.flag("level")),
      publish_period_(parameters.number("publish_period")),
      live_(read_settings(parameters, sensor)) {}

TileMask MapKeeper::take(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& measured,
                         const SensorSettings& sensor) {
  FusionResult result =
      live_.fuse(cloud, refined(cloud, in_map(cloud, pose), sensor), measured, sensor.noise);
  if (result.used == 0)
    throw Error(
        fmt::format("none of {} points can be used: {} not finite, {} out of range, {} outside the map",
                    cloud.size(), result.not_finite, result.out_of_range, result.outside));
  const std::string line = fmt::format("{} of {} points used, {} cells refused as outliers", result.used,
                                       cloud.size(), result.outlier_cells);
  const bool contradicts = result.outliers > result.used / 2;
  tell_(sensor.thing("clouds"), !contradicts,
        contradicts ? "most contradict the map (a sensor or a tf that moved?): " + line : line);
  return std::move(result.changed);
}

bool MapKeeper::is_due(const ros::Time& measured) {
  if (measured >= published_ && measured - published_ < publish_period_) return false;
  published_ = measured;
  return true;
}

/// The pose in the frame of the map; the first cloud says where that is when it is to lie along the bed.
Eigen::Isometry3d MapKeeper::in_map(const PointCloud& cloud, const Eigen::Isometry3d& pose) {
  if (!level_) return pose;
  if (!bed_) {
    bed_ = fit_bed_frame(cloud, pose);
    bed_found_(*bed_);
    const double slope = std::acos(std::clamp(bed_->linear()(2, 2), -1.0, 1.0));
    tell_(
        "bed", true,
        fmt::format("leans by {:.2f} degrees: '{}' lies along it", radians_to_degrees(slope), live_.frame()));
  }
  return bed_->inverse() * pose;
}

/// The pose refined against the map when this is asked for and can be done.
Eigen::Isometry3d MapKeeper::refined(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                     const SensorSettings& sensor) {
  if (!sensor.registration || !live_.begun()) return pose;
  if (count_known(live_.map().layer(layer::elevation)) == 0) return pose;
  const std::string thing = sensor.thing("registration");
  const Registration result = register_cloud(cloud, pose, live_.map(), *sensor.registration);
  if (result.accepted)
    tell_(thing, true,
          fmt::format("moved by {:.2f} mm, turned by {:.3f} degrees; {} of 6 degrees of freedom, median "
                      "distance {:.2f} mm",
                      1e3 * result.shift, radians_to_degrees(result.angle), result.held,
                      1e3 * result.median_residual));
  else
    tell_(thing, false, "refused, the cloud is used as tf says: " + result.reason);
  return result.pose;
}

}  // namespace aeolian
