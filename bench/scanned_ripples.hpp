#pragma once

#include <cmath>
#include <cstdint>

#include <geometry_msgs/TransformStamped.h>
#include <ros/time.h>

#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian::bench {

/// What a camera of depths sees that looks straight down on ripples of 10 cm, which migrate at 3 cm/min.
struct ScannedRipples {
  static constexpr double camera_height = 1.2;  ///< [m]
  static constexpr double noise = 0.0006;       ///< of a point, along its ray [m]

  int columns = 640;
  int rows = 480;
  double length_x = 1;  ///< that it sees [m]
  double length_y = 0.5;
  double height = 0.005;  ///< of the ripples [m]

  /// In the camera's frame; each number has noise of its own.
  PointCloud at(double time, std::uint64_t number) const {
    RandomStream random(1, number);
    PointCloud cloud;
    cloud.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
    for (int v = 0; v < rows; ++v)
      for (int u = 0; u < columns; ++u) {
        const double x = length_x * ((u + 0.5) / columns - 0.5);
        const double y = length_y * ((v + 0.5) / rows - 0.5);
        const double bed = height / 2 * std::sin(2 * M_PI * (x - 0.0005 * time) / 0.1);
        cloud.push_back(static_cast<float>(x), static_cast<float>(y),
                        static_cast<float>(camera_height - bed + noise * random.normal()));
      }
    return cloud;
  }
};

/// Of the frame `camera` in `map`, over (x, y) [m].
inline geometry_msgs::TransformStamped camera_pose(const ros::Time& stamp, double x, double y) {
  geometry_msgs::TransformStamped pose;
  pose.header.stamp = stamp;
  pose.header.frame_id = "map";
  pose.child_frame_id = "camera";
  pose.transform.translation.x = x;
  pose.transform.translation.y = y;
  pose.transform.translation.z = ScannedRipples::camera_height;
  pose.transform.rotation.x = 1;
  return pose;
}

}  // namespace aeolian::bench
