#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Image.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/yaml_section.hpp"

namespace aeolian {

/// A photo in any format that OpenCV reads, upright as its EXIF data say; grey or colour, 8 or 16 bits.
/// Throws Error naming the file.
inline sensor_msgs::Image read_image(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) throw Error("photo '" + path + "': there is no such file");
  cv::Mat photo;
  try {
    photo = cv::imread(path, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
  } catch (const cv::Exception& error) {
    throw Error("photo '" + path + "': " + error.err);
  }
  if (photo.empty()) throw Error("photo '" + path + "': is not an image that OpenCV can read");
  sensor_msgs::Image message;
  switch (photo.type()) {
    case CV_8UC1:
      message.encoding = "mono8";
      break;
    case CV_16UC1:
      message.encoding = "mono16";
      break;
    case CV_8UC3:
      message.encoding = "bgr8";
      break;
    case CV_16UC3:
      message.encoding = "bgr16";
      break;
    default:
      throw Error("photo '" + path + "': has neither 8 nor 16 bits");
  }
  message.width = static_cast<std::uint32_t>(photo.cols);
  message.height = static_cast<std::uint32_t>(photo.rows);
  message.step = static_cast<std::uint32_t>(photo.elemSize()) * message.width;
  for (int row = 0; row < photo.rows; ++row)
    message.data.insert(message.data.end(), photo.ptr(row), photo.ptr(row) + message.step);
  return message;
}

/// A camera's calibration as ROS' camera_calibration writes it. Without rectification_matrix and
/// projection_matrix they are the identity and the camera matrix. Throws Error naming file and key.
inline sensor_msgs::CameraInfo read_camera_info(const std::string& path) {
  YamlSection root = YamlSection::load(path);
  sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(root.integer("image_width", 1, 1 << 20));
  info.height = static_cast<std::uint32_t>(root.integer("image_height", 1, 1 << 20));
  info.distortion_model = root.text("distortion_model");
  info.D = root.section("distortion_coefficients").numbers("data");
  const std::vector<double> k = root.section("camera_matrix").numbers("data", 9);
  std::copy(k.begin(), k.end(), info.K.begin());
  info.R = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  info.P = {k[0], k[1], k[2], 0, k[3], k[4], k[5], 0, k[6], k[7], k[8], 0};
  if (root.has("rectification_matrix")) {
    const std::vector<double> r = root.section("rectification_matrix").numbers("data", 9);
    std::copy(r.begin(), r.end(), info.R.begin());
  }
  if (root.has("projection_matrix")) {
    const std::vector<double> p = root.section("projection_matrix").numbers("data", 12);
    std::copy(p.begin(), p.end(), info.P.begin());
  }
  return info;
}

}  // namespace aeolian
