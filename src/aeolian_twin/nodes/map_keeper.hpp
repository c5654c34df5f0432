#pragma once

#include <functional>
#include <memory>
#include <optional>

#include <Eigen/Geometry>

#include "aeolian_twin/nodes/live_map.hpp"
#include "aeolian_twin/nodes/parameters.hpp"
#include "aeolian_twin/nodes/sensor_settings.hpp"
#include "aeolian_twin/nodes/tell.hpp"

namespace aeolian {

/// What height_mapper makes of clouds whose pose is known: refined against the map, in the frame of the bed,
/// fused. The node and `replay` share it; it needs no master.
class MapKeeper {
 public:
  /// Told once, when the map is to lie along the bed and the first cloud says where that is: the pose of the
  /// map's frame in ~frame_id.
  using BedFound = std::function<void(const Eigen::Isometry3d& bed)>;

  /// Throws Error for parameters of height_mapper that do not fit together.
  MapKeeper(const Parameters& parameters, const SensorNoise& sensor, Tell tell, BedFound bed_found);

  LiveMap& live() { return live_; }
  const LiveMap& live() const { return live_; }

  /// Fuses a cloud and gives the tiles that it changed. Throws Error for one of which no point can be used.
  TileMask take(const PointCloud& cloud, const Eigen::Isometry3d& pose, const ros::Time& measured,
                const SensorSettings& sensor);
  /// Whether a map is to be published after a cloud of that time; it then counts as published.
  bool is_due(const ros::Time& measured);

 private:
  Eigen::Isometry3d in_map(const PointCloud& cloud, const Eigen::Isometry3d& pose);
  Eigen::Isometry3d refined(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                            const SensorSettings& sensor);

  Tell tell_;
  BedFound bed_found_;
  bool level_;
  ros::Duration publish_period_;
  LiveMap live_;
  std::optional<Eigen::Isometry3d> bed_;  ///< frame of the map in ~frame_id, when it lies along the bed
  ros::Time published_;
};

}  // namespace aeolian
