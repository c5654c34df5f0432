#pragma once

#include <initializer_list>

#include <sensor_msgs/PointCloud2.h>

namespace aeolian {

/// Makes the points of a cloud consist of these fields, a float each.
inline void set_float_fields(sensor_msgs::PointCloud2& cloud, std::initializer_list<const char*> names) {
  cloud.fields.clear();
  for (const char* name : names) {
    sensor_msgs::PointField field;
    field.name = name;
    field.offset = static_cast<std::uint32_t>(cloud.fields.size() * sizeof(float));
    field.datatype = sensor_msgs::PointField::FLOAT32;
    field.count = 1;
    cloud.fields.push_back(field);
  }
  cloud.point_step = static_cast<std::uint32_t>(names.size() * sizeof(float));
}

}  // namespace aeolian
