#pragma once

#include <string>

#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

/// A sensor_msgs/PointCloud2 as it is read from a bag: its points go straight from the bag's buffer to where
/// the fusion wants them, without a message in between.
struct ReadCloud {
  std_msgs::Header header;
  PointCloud points;
  std::string refused;  ///< why there are none; empty: there are
};

/// Throws Error for a message that was refused.
inline const PointCloud& points_of(const ReadCloud& cloud, PointCloud& /*memory*/) {
  if (!cloud.refused.empty()) throw Error(cloud.refused);
  return cloud.points;
}

}  // namespace aeolian

/// What rosbag and tf2 must know of it.
namespace ros {
namespace message_traits {

template <>
struct IsMessage<aeolian::ReadCloud> : TrueType {};
template <>
struct HasHeader<aeolian::ReadCloud> : TrueType {};
template <>
struct MD5Sum<aeolian::ReadCloud> : MD5Sum<sensor_msgs::PointCloud2> {
  static const char* value() { return MD5Sum<sensor_msgs::PointCloud2>::value(); }
  static const char* value(const aeolian::ReadCloud&) { return value(); }
};
template <>
struct DataType<aeolian::ReadCloud> {
  static const char* value() { return DataType<sensor_msgs::PointCloud2>::value(); }
  static const char* value(const aeolian::ReadCloud&) { return value(); }
};

}  // namespace message_traits

namespace serialization {

template <>
struct Serializer<aeolian::ReadCloud> {
  template <typename Stream>
  static void read(Stream& stream, aeolian::ReadCloud& cloud) {
    sensor_msgs::PointCloud2 layout;
    stream.next(layout.header);
    stream.next(layout.height);
    stream.next(layout.width);
    stream.next(layout.fields);
    stream.next(layout.is_bigendian);
    stream.next(layout.point_step);
    stream.next(layout.row_step);
    std::uint32_t size = 0;
    stream.next(size);
    const std::uint8_t* const data = stream.advance(size);
    cloud.header = layout.header;
    try {
      cloud.points = aeolian::to_point_cloud(layout, data, size);
    } catch (const aeolian::Error& error) {
      cloud.refused = error.what();
    }
  }
};

}  // namespace serialization
}  // namespace ros
