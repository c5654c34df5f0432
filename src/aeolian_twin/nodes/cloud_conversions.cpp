#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/float_fields.hpp"

namespace aeolian {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr std::size_t points_at_once = 512;

/// Where a coordinate lies within a point.
struct Coordinate {
  std::size_t offset;
  bool is_double;
  bool swapped;

  bool is_plain_float() const { return !is_double && !swapped; }
  double read(const std::uint8_t* point) const {
    return is_double ? value<double>(point) : value<float>(point);
  }

 private:
  template <class T>
  double value(const std::uint8_t* point) const {
    std::array<std::uint8_t, sizeof(T)> bytes;
    std::memcpy(bytes.data(), point + offset, sizeof(T));
    if (swapped) std::reverse(bytes.begin(), bytes.end());
    T result;
    std::memcpy(&result, bytes.data(), sizeof(T));
    return static_cast<double>(result);
  }
};

constexpr bool machine_is_big_endian = __BYTE_ORDER__ == __ORDER_BIG_ENDIAN__;

Coordinate find_coordinate(const PointCloud2& message, const std::string& name) {
  const auto found = std::find_if(message.fields.begin(), message.fields.end(),
                                  [&](const PointField& field) { return field.name == name; });
  if (found == message.fields.end()) throw Error(fmt::format("point cloud: there is no field '{}'", name));
  const bool is_double = found->datatype == PointField::FLOAT64;
  if (!is_double && found->datatype != PointField::FLOAT32)
    throw Error(fmt::format("point cloud: field '{}' has datatype {}, must be FLOAT32 (7) or FLOAT64 (8)",
                            name, found->datatype));
  if (std::uint64_t{found->offset} + (is_double ? 8 : 4) > message.point_step)
    throw Error(fmt::format("point cloud: field '{}' at offset {} does not fit a point_step of {}", name,
                            found->offset, message.point_step));
  return {found->offset, is_double, (message.is_bigendian != 0) != machine_is_big_endian};
}

void check_size(const PointCloud2& message, std::size_t size) {
  const std::uint64_t row = std::uint64_t{message.width} * message.point_step;
  const bool one_row = message.height <= 1;
  const std::uint64_t step = one_row ? row : message.row_step;
  if (step < row)
    throw Error(fmt::format("point cloud: row_step is {}, must be at least {} ({} points of {} bytes)", step,
                            row, message.width, message.point_step));
  const std::uint64_t needed = message.height == 0 ? 0 : step * (message.height - 1) + row;
  if (size < needed)
    throw Error(fmt::format("point cloud: data has {} bytes, must have {} ({} x {} points of {} bytes)", size,
                            needed, message.width, message.height, message.point_step));
}

/// Appends a coordinate of points that is a float in this machine's order, by way of the fast cache.
void append(const std::uint8_t* from, std::size_t step, std::size_t count, std::vector<float>& values) {
  std::array<float, points_at_once> block;
  for (std::size_t i = 0; i < count; ++i) std::memcpy(&block[i], from + i * step, sizeof(float));
  values.insert(values.end(), block.begin(), block.begin() + static_cast<std::ptrdiff_t>(count));
}

}  // namespace

PointCloud to_point_cloud(const PointCloud2& message, PointCloud reused) {
  return to_point_cloud(message, message.data.data(), message.data.size(), std::move(reused));
}

PointCloud to_point_cloud(const PointCloud2& message, const std::uint8_t* data, std::size_t size,
                          PointCloud reused) {
  const Coordinate x = find_coordinate(message, "x");
  const Coordinate y = find_coordinate(message, "y");
  const Coordinate z = find_coordinate(message, "z");
  check_size(message, size);
  constexpr double far = 1000;  // a float still resolves 0.06 mm here
  PointCloud cloud = std::move(reused);
  cloud.clear();
  cloud.reserve(std::size_t{message.width} * message.height);
  const std::size_t row_step = message.height <= 1 ? 0 : message.row_step;
  const auto for_each_point = [&](auto&& visit) {
    for (std::size_t row = 0; row < message.height; ++row) {
      const std::uint8_t* point = data + row * row_step;
      for (std::size_t i = 0; i < message.width; ++i, point += message.point_step)
        if (!visit(x.read(point), y.read(point), z.read(point))) return;
    }
  };
  for_each_point([&](double px, double py, double pz) {
    if (!std::isfinite(px) || !std::isfinite(py) || !std::isfinite(pz)) return true;
    if (std::max({std::abs(px), std::abs(py), std::abs(pz)}) > far) {
      cloud.origin_x = std::round(px);
      cloud.origin_y = std::round(py);
      cloud.origin_z = std::round(pz);
    }
    return false;
  });
  const bool about_zero = cloud.origin_x == 0 && cloud.origin_y == 0 && cloud.origin_z == 0;
  if (about_zero && x.is_plain_float() && y.is_plain_float() && z.is_plain_float()) {
    const std::size_t step = message.point_step;
    for (std::size_t row = 0; row < message.height; ++row)
      for (std::size_t i = 0; i < message.width; i += points_at_once) {
        const std::size_t count = std::min(points_at_once, message.width - i);
        const std::uint8_t* const first = data + row * row_step + i * step;
        append(first + x.offset, step, count, cloud.x);
        append(first + y.offset, step, count, cloud.y);
        append(first + z.offset, step, count, cloud.z);
      }
    return cloud;
  }
  for_each_point([&](double px, double py, double pz) {
    cloud.push_back(static_cast<float>(px - cloud.origin_x), static_cast<float>(py - cloud.origin_y),
                    static_cast<float>(pz - cloud.origin_z));
    return true;
  });
  return cloud;
}

sensor_msgs::PointCloud2 to_message(const PointCloud& cloud, std::size_t width) {
  sensor_msgs::PointCloud2 message;
  set_float_fields(message, {"x", "y", "z"});
  message.width = static_cast<std::uint32_t>(width > 0 ? width : cloud.size());
  message.height = static_cast<std::uint32_t>(width > 0 ? cloud.size() / width : 1);
  message.row_step = message.point_step * message.width;
  message.data.resize(std::size_t{message.row_step} * message.height);
  bool dense = true;
  std::uint8_t* to = message.data.data();
  for (std::size_t i = 0; i < cloud.size(); ++i, to += message.point_step) {
    const std::array<float, 3> point{cloud.x[i], cloud.y[i], cloud.z[i]};
    std::memcpy(to, point.data(), sizeof(point));
    dense = dense && std::isfinite(point[0]);
  }
  message.is_dense = dense;
  return message;
}

}  // namespace aeolian
