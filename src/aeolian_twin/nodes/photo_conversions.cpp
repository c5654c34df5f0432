#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include <fmt/format.h>
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/float_fields.hpp"

namespace aeolian {
namespace {

/// What OpenCV needs to know of an encoding.
struct Encoding {
  const char* name;
  int type;
  int to_grey;  ///< conversion codes, -1: none
  int to_bgr;
};

constexpr std::array<Encoding, 6> encodings = {{{"mono8", CV_8UC1, -1, cv::COLOR_GRAY2BGR},
                                                {"mono16", CV_16UC1, -1, cv::COLOR_GRAY2BGR},
                                                {"bgr8", CV_8UC3, cv::COLOR_BGR2GRAY, -1},
                                                {"rgb8", CV_8UC3, cv::COLOR_RGB2GRAY, cv::COLOR_RGB2BGR},
                                                {"bgra8", CV_8UC4, cv::COLOR_BGRA2GRAY, cv::COLOR_BGRA2BGR},
                                                {"rgba8", CV_8UC4, cv::COLOR_RGBA2GRAY, cv::COLOR_RGBA2BGR}}};

const Encoding& encoding_of(const sensor_msgs::Image& message) {
  const auto found = std::find_if(encodings.begin(), encodings.end(),
                                  [&](const Encoding& e) { return message.encoding == e.name; });
  if (found == encodings.end())
    throw Error(
        fmt::format("image: encoding is '{}', must be mono8, mono16, bgr8, rgb8, bgra8 or rgba8 (a raw or "
                    "compressed camera needs image_proc or a republisher before)",
                    message.encoding));
  return *found;
}

/// The image as it lies in the message, in the machine's byte order.
cv::Mat stored(const sensor_msgs::Image& message, const Encoding& encoding) {
  const auto pixel = static_cast<std::size_t>(CV_ELEM_SIZE(encoding.type));
  if (message.width == 0 || message.height == 0)
    throw Error(fmt::format("image: it has {} x {} pixels", message.width, message.height));
  if (message.step < message.width * pixel)
    throw Error(fmt::format("image: step is {}, must be at least {} ({} pixels of {} bytes)", message.step,
                            message.width * pixel, message.width, pixel));
  const std::size_t needed = std::size_t{message.step} * (message.height - 1) + message.width * pixel;
  if (message.data.size() < needed)
    throw Error(fmt::format("image: data has {} bytes, must have {} ({} x {} pixels of {} bytes)",
                            message.data.size(), needed, message.width, message.height, pixel));
  cv::Mat image(static_cast<int>(message.height), static_cast<int>(message.width), encoding.type);
  for (int row = 0; row < image.rows; ++row)
    std::memcpy(image.ptr(row), message.data.data() + static_cast<std::size_t>(row) * message.step,
                message.width * pixel);
  constexpr bool machine_is_big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;
  if (encoding.type == CV_16UC1 && (message.is_bigendian != 0) != machine_is_big_endian)
    std::for_each(image.begin<std::uint16_t>(), image.end<std::uint16_t>(),
                  [](std::uint16_t& v) { v = static_cast<std::uint16_t>(v << 8 | v >> 8); });
  return image;
}

}  // namespace

Photo to_photo(const sensor_msgs::Image& message) {
  const Encoding& encoding = encoding_of(message);
  cv::Mat image = stored(message, encoding);
  if (encoding.to_grey >= 0) cv::cvtColor(image, image, encoding.to_grey);
  Photo photo;
  photo.width_px = image.cols;
  photo.height_px = image.rows;
  if (image.type() == CV_16UC1) {
    photo.white = 65535;
    photo.values16.assign(image.begin<std::uint16_t>(), image.end<std::uint16_t>());
  } else {
    photo.values8.assign(image.datastart, image.dataend);
  }
  return photo;
}

cv::Mat to_picture(const sensor_msgs::Image& message) {
  const Encoding& encoding = encoding_of(message);
  cv::Mat image = stored(message, encoding);
  if (image.type() == CV_16UC1) image.convertTo(image, CV_8U, 1.0 / 257);
  if (encoding.to_bgr >= 0) cv::cvtColor(image, image, encoding.to_bgr);
  return image;
}

sensor_msgs::Image to_message(const cv::Mat& picture, const std_msgs::Header& header) {
  if (picture.type() != CV_8UC3) throw Error("picture: must have three channels of 8 bits");
  sensor_msgs::Image message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(picture.cols);
  message.height = static_cast<std::uint32_t>(picture.rows);
  message.encoding = "bgr8";
  message.step = 3 * message.width;
  message.data.reserve(std::size_t{message.step} * message.height);
  for (int row = 0; row < picture.rows; ++row)
    message.data.insert(message.data.end(), picture.ptr(row), picture.ptr(row) + message.step);
  return message;
}

CameraModel to_camera_model(const sensor_msgs::CameraInfo& message) {
  const auto& k = message.K;
  if (!(k[0] > 0 && k[4] > 0))
    throw Error(fmt::format(
        "camera info: K has focal lengths {} and {}, must be positive (is the camera calibrated?)", k[0],
        k[4]));
  if (k[1] != 0) throw Error(fmt::format("camera info: K has a skew of {}, must be without", k[1]));
  if (message.binning_x > 1 || message.binning_y > 1)
    throw Error(fmt::format("camera info: binning is {} x {}, must be without", message.binning_x,
                            message.binning_y));
  const auto& roi = message.roi;
  const bool whole = roi.x_offset == 0 && roi.y_offset == 0 &&
                     (roi.width == 0 || roi.width == message.width) &&
                     (roi.height == 0 || roi.height == message.height);
  if (!whole) throw Error("camera info: roi is a part of the picture, must be all of it");
  CameraModel camera;
  camera.width_px = static_cast<int>(message.width);
  camera.height_px = static_cast<int>(message.height);
  camera.fx = k[0];
  camera.fy = k[4];
  camera.cx = k[2];
  camera.cy = k[5];
  const std::string& model = message.distortion_model;
  const std::size_t count = message.D.size();
  const bool plumb_bob = model == "plumb_bob" && (count == 4 || count == 5);
  const bool rational = model == "rational_polynomial" && count == 8;
  if (!plumb_bob && !rational && !(model.empty() && count == 0))
    throw Error(fmt::format(
        "camera info: distortion_model is '{}' with {} coefficients, must be plumb_bob with 4 or 5 "
        "or rational_polynomial with 8",
        model, count));
  if (!std::all_of(message.D.begin(), message.D.end(), [](double d) { return std::isfinite(d); }) ||
      !std::isfinite(k[2]) || !std::isfinite(k[5]) || !std::isfinite(k[0]) || !std::isfinite(k[4]))
    throw Error("camera info: K or D holds a number that is not finite");
  std::copy(message.D.begin(), message.D.end(), camera.distortion.begin());
  return camera;
}

aeolian_msgs::Profile to_message(const ShadowProfile& profile, const ProfileAnalysis& analysis,
                                 const std::vector<Eigen::Vector3d>& points, const std_msgs::Header& header) {
  aeolian_msgs::Profile message;
  message.header = header;
  message.x = profile.x;
  message.z = profile.z;
  message.sigma_z = profile.sigma_z;
  for (const Eigen::Vector3d& point : points) {
    geometry_msgs::Point& p = message.points.emplace_back();
    p.x = point.x();
    p.y = point.y();
    p.z = point.z();
  }
  message.wavelength = analysis.wavelength.value;
  message.height = analysis.height.value;
  return message;
}

sensor_msgs::PointCloud2 to_cloud(const std::vector<Eigen::Vector3d>& points,
                                  const std::vector<double>& sigma_z, const std_msgs::Header& header) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  set_float_fields(cloud, {"x", "y", "z", "sigma_z"});
  cloud.width = static_cast<std::uint32_t>(points.size());
  cloud.height = 1;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.is_dense = 1;
  cloud.data.resize(cloud.row_step);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::array<float, 4> values{static_cast<float>(points[i].x()), static_cast<float>(points[i].y()),
                                      static_cast<float>(points[i].z()), static_cast<float>(sigma_z[i])};
    std::memcpy(cloud.data.data() + i * cloud.point_step, values.data(), sizeof(values));
  }
  return cloud;
}

}  // namespace aeolian
