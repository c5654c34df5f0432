#pragma once

#include <cmath>
#include <string>

#include <geometry_msgs/TwistStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_msgs/TFMessage.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

/// What a small recorded field day holds: ripples of 4 cm on 0.2 m x 0.1 m that migrate at 0.5 mm/s under a
/// wind towards the east, seen from above.
struct SmallDay {
  int seconds = 8;
  bool clouds = true;
  bool wind = true;
  bool tf = true;
  double tf_delay = 0;  ///< after the first cloud [s]; 0: before it

  static ros::Time start() { return ros::Time(1700000000, 250000000); }
};

/// A cloud of 20000 points a second, half a second after the wind.
inline sensor_msgs::PointCloud2 small_cloud(int second) {
  RandomStream random(1, static_cast<std::uint64_t>(second));
  PointCloud cloud;
  for (int v = 0; v < 100; ++v)
    for (int u = 0; u < 200; ++u) {
      const double x = 0.001 * (u + 0.5) - 0.1;
      const double y = 0.001 * (v + 0.5) - 0.05;
      const double bed = 0.0015 * std::sin(2 * M_PI * (x - 0.0005 * second) / 0.04);
      cloud.push_back(static_cast<float>(x), static_cast<float>(-y),
                      static_cast<float>(1 - bed + 0.0003 * random.normal()));
    }
  sensor_msgs::PointCloud2 message = to_message(cloud, 200);
  message.header.frame_id = "scanner";
  message.header.stamp = SmallDay::start() + ros::Duration(second + 0.5);
  return message;
}

inline geometry_msgs::TwistStamped small_wind(int second) {
  geometry_msgs::TwistStamped message;
  message.header.frame_id = "map";
  message.header.stamp = SmallDay::start() + ros::Duration(second);
  message.twist.linear.x = 11 + std::sin(second);
  message.twist.linear.y = 0.5;
  return message;
}

/// A scanner 1 m over the plot that looks down.
inline tf2_msgs::TFMessage small_frames() {
  tf2_msgs::TFMessage message;
  geometry_msgs::TransformStamped& pose = message.transforms.emplace_back();
  pose.header.frame_id = "map";
  pose.header.stamp = SmallDay::start();
  pose.child_frame_id = "scanner";
  pose.transform.translation.x = 0.1;
  pose.transform.translation.y = 0.05;
  pose.transform.translation.z = 1;
  pose.transform.rotation.x = 1;
  return message;
}

inline void write_small_day(const std::string& path, const SmallDay& day) {
  rosbag::Bag bag(path, rosbag::bagmode::Write);
  const ros::Time start = SmallDay::start();
  if (day.tf)
    bag.write("/tf_static", start + ros::Duration(day.tf_delay > 0 ? 0.5 + day.tf_delay : 0), small_frames());
  for (int second = 0; second <= day.seconds; ++second) {
    if (day.wind) {
      const geometry_msgs::TwistStamped wind = small_wind(second);
      bag.write("/wind", wind.header.stamp, wind);
    }
    if (day.clouds) {
      const sensor_msgs::PointCloud2 cloud = small_cloud(second);
      bag.write("/points", cloud.header.stamp, cloud);
    }
  }
  bag.close();
}

}  // namespace aeolian
