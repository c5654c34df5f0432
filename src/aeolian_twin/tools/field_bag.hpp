#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <geometry_msgs/TwistStamped.h>
#include <rosbag/bag.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_msgs/TFMessage.h>

#include "aeolian_core/measure/measure.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/tools/field_day.hpp"
#include "aeolian_twin/tools/static_frames.hpp"

namespace aeolian {

/// The bag of a virtual field day: /points, /wind, /image, /camera_info, /tf_static. Times count from the
/// day's start; a message's stamp is its time in the bag.
class FieldBag {
 public:
  FieldBag(rosbag::Bag& bag, double start) : start_(start), bag_(bag) {}

  /// The places of sensors and straightedge in `map`.
  void write_frames(const FieldDay& day) {
    tf2_msgs::TFMessage frames;
    const auto add = [&](const std::string& name, const Eigen::Isometry3d& pose) {
      geometry_msgs::TransformStamped frame = tf2::eigenToTransform(pose);
      frame.header.stamp = stamp(0);
      frame.header.frame_id = "map";
      frame.child_frame_id = name;
      frames.transforms.push_back(frame);
    };
    for (std::size_t i = 0; i < day.scanners.size(); ++i) add(scanner_frame(i), day.scanners[i].pose);
    add("camera", day.camera.pose);
    add("anemometer", day.anemometer_pose);
    add("straightedge", straightedge_pose(day.straightedge));
    write_static_frames(bag_, frames, stamp(0), "simulate_field");
  }

  void write(const VirtualAnemometer::Sample& sample) {
    geometry_msgs::TwistStamped message;
    message.twist.linear.x = sample.speed * std::cos(sample.direction);
    message.twist.linear.y = sample.speed * std::sin(sample.direction);
    write("/wind", sample.time, "anemometer", std::move(message));
  }

  /// A scan of the scanner of a number.
  void write(const PointCloud& cloud, const VirtualScanner& scanner, std::size_t number, double time) {
    write("/points", time, scanner_frame(number),
          to_message(cloud, static_cast<std::size_t>(scanner.columns)));
  }

  /// A photograph and the camera's intrinsics.
  void write(std::vector<std::uint8_t> photograph, const VirtualCamera& camera, double time) {
    sensor_msgs::Image image;
    image.width = static_cast<std::uint32_t>(camera.width_px);
    image.height = static_cast<std::uint32_t>(camera.height_px);
    image.encoding = "mono8";
    image.step = image.width;
    image.data = std::move(photograph);

    sensor_msgs::CameraInfo info;
    info.width = image.width;
    info.height = image.height;
    info.distortion_model = "plumb_bob";
    info.D.assign(5, 0);
    const double f = camera.focal_px;
    // Pixel centres are whole numbers in ROS: the middle of the picture lies half a pixel before width / 2.
    const double cx = 0.5 * (camera.width_px - 1);
    const double cy = 0.5 * (camera.height_px - 1);
    info.K = {f, 0, cx, 0, f, cy, 0, 0, 1};
    info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    info.P = {f, 0, cx, 0, 0, f, cy, 0, 0, 0, 1, 0};
    write("/image", time, "camera", std::move(image));
    write("/camera_info", time, "camera", std::move(info));
  }

 private:
  static std::string scanner_frame(std::size_t number) { return fmt::format("scanner_{}", number + 1); }

  ros::Time stamp(double time) const {
    const double whole = std::floor(start_);
    return ros::Time(static_cast<std::uint32_t>(whole), 0) + ros::Duration(time + (start_ - whole));
  }

  template <class Message>
  void write(const std::string& topic, double time, const std::string& frame, Message&& message) {
    message.header.stamp = stamp(time);
    message.header.frame_id = frame;
    bag_.write(topic, message.header.stamp, message);
  }

  double start_;
  rosbag::Bag& bag_;
};

}  // namespace aeolian
