#pragma once

#include <memory>
#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <geometry_msgs/TwistStamped.h>
#include <grid_map_msgs/GridMap.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>

#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_twin/nodes/parameters.hpp"
#include "aeolian_twin/nodes/tell.hpp"

namespace aeolian {

/// What wind_estimator makes of an anemometer's readings. The node and `replay` share it; it needs no master.
class WindReader {
 public:
  /// `topic` of the readings; `transforms` must outlive this.
  WindReader(const Parameters& parameters, const std::string& topic, const tf2::BufferCore& transforms,
             Tell tell);

  /// Takes the ground. Throws Error for what is no map.
  void take_map(const grid_map_msgs::GridMap& message);
  /// The wind field of a reading; nothing, and told, when there is none.
  std::optional<grid_map_msgs::GridMap> take_wind(const geometry_msgs::TwistStamped& message);

 private:
  WindField solve(const geometry_msgs::TwistStamped& message);
  std::optional<Eigen::Isometry3d> anemometer_pose(const std_msgs::Header& header) const;
  void notice_time(const ros::Time& stamp);

  std::string topic_;
  const tf2::BufferCore& transforms_;
  Tell tell_;
  std::string frame_;
  double anemometer_height_;
  double air_density_;
  double max_speed_;
  double max_gap_;
  std::unique_ptr<WindModel> model_;
  HeightMap map_;
  double ground_ = 0;  ///< mean elevation of the map [m]
  ros::Time last_stamp_;
};

}  // namespace aeolian
