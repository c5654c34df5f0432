#include "aeolian_core/surface/pcl_file.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <pcl/PCLPointCloud2.h>
#include <pcl/io/pcd_io.h>
#include <pcl/io/ply_io.h>

#include "aeolian_core/surface/cloud_text.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/quiet_pcl.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

constexpr const char* damaged = "is damaged or not of the format that its name says";

template <class Number>
void copy_values(const pcl::PCLPointCloud2& blob, std::size_t offset, std::vector<double>& values) {
  const std::size_t row_step = std::size_t{blob.width} * blob.point_step;
  values.reserve(std::size_t{blob.width} * blob.height);
  for (std::size_t row = 0; row < blob.height; ++row) {
    const std::uint8_t* at = blob.data.data() + row * row_step + offset;
    for (std::size_t i = 0; i < blob.width; ++i, at += blob.point_step) {
      Number value{};
      std::memcpy(&value, at, sizeof(Number));
      values.push_back(static_cast<double>(value));
    }
  }
}

using CopyValues = void (*)(const pcl::PCLPointCloud2&, std::size_t, std::vector<double>&);

/// Null for a type that is no number.
CopyValues copy_values_of(std::uint8_t type) {
  using Field = pcl::PCLPointField;
  switch (type) {
    case Field::FLOAT32:
      return copy_values<float>;
    case Field::FLOAT64:
      return copy_values<double>;
    case Field::INT8:
      return copy_values<std::int8_t>;
    case Field::UINT8:
      return copy_values<std::uint8_t>;
    case Field::INT16:
      return copy_values<std::int16_t>;
    case Field::UINT16:
      return copy_values<std::uint16_t>;
    case Field::INT32:
      return copy_values<std::int32_t>;
    case Field::UINT32:
      return copy_values<std::uint32_t>;
    default:
      return nullptr;
  }
}

std::vector<double> field_values(const pcl::PCLPointCloud2& blob, const std::string& name,
                                 const std::string& where) {
  const auto field =
      std::find_if(blob.fields.begin(), blob.fields.end(),
                   [&](const pcl::PCLPointField& candidate) { return candidate.name == name; });
  const CopyValues copy = field == blob.fields.end() ? nullptr : copy_values_of(field->datatype);
  if (copy == nullptr) throw Error(where + "has no field " + name + ", must have the numbers x, y and z");
  std::vector<double> values;
  copy(blob, field->offset, values);
  return values;
}

/// The lines of an ASCII PCD. PCL would take a word for the number zero; our reader names the line.
Coordinates read_ascii_pcd(const std::string& path, std::size_t start, const pcl::PCLPointCloud2& header,
                           const std::string& where) {
  CloudColumns columns{};
  const char* names[] = {"x", "y", "z"};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::size_t column = 0;
    auto field = header.fields.begin();
    for (; field != header.fields.end() && field->name != names[axis]; ++field) column += field->count;
    if (field == header.fields.end())
      throw Error(where + "has no field " + names[axis] + ", must have the numbers x, y and z");
    columns[axis] = column;
  }
  Coordinates points = read_cloud_columns(path, start, columns);
  const std::size_t promised = std::size_t{header.width} * header.height;
  if (points.x.size() != promised)
    throw Error(where + "has " + std::to_string(points.x.size()) + " points, its header says " +
                std::to_string(promised));
  return points;
}

Coordinates coordinates_of(const pcl::PCLPointCloud2& blob, int status, const std::string& where) {
  const bool whole = blob.data.size() >= std::size_t{blob.width} * blob.height * blob.point_step;
  if (status < 0 || !whole) throw Error(where + damaged);
  return {field_values(blob, "x", where), field_values(blob, "y", where), field_values(blob, "z", where)};
}

Coordinates read_pcd(const std::string& path, const std::string& where) {
  pcl::PCDReader reader;
  pcl::PCLPointCloud2 blob;
  Eigen::Vector4f origin;
  Eigen::Quaternionf orientation;
  int version = 0;
  int encoding = 0;
  unsigned start = 0;
  const int status = reader.readHeader(path, blob, origin, orientation, version, encoding, start);
  // PCL's reader crashes on a header without fields.
  if (status < 0 || blob.fields.empty()) throw Error(where + damaged);
  const bool ascii = encoding == 0;
  if (ascii) return read_ascii_pcd(path, start, blob, where);
  const int body_status = reader.read(path, blob);
  return coordinates_of(blob, body_status, where);
}

Coordinates read_ply(const std::string& path, const std::string& where) {
  pcl::PCLPointCloud2 blob;
  const int status = pcl::PLYReader().read(path, blob);
  return coordinates_of(blob, status, where);
}

pcl::PCLPointCloud2 blob_of(const Coordinates& points) {
  const std::size_t count = points.x.size();
  pcl::PCLPointCloud2 blob;
  blob.height = 1;
  blob.width = static_cast<std::uint32_t>(count);
  blob.point_step = 3 * sizeof(double);
  blob.row_step = blob.width * blob.point_step;
  blob.is_dense = true;
  blob.data.resize(count * blob.point_step);
  const std::vector<double>* columns[] = {&points.x, &points.y, &points.z};
  const char* names[] = {"x", "y", "z"};
  for (std::uint32_t c = 0; c < 3; ++c) {
    pcl::PCLPointField field;
    field.name = names[c];
    field.offset = c * static_cast<std::uint32_t>(sizeof(double));
    field.datatype = pcl::PCLPointField::FLOAT64;
    field.count = 1;
    blob.fields.push_back(field);
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(&blob.data[i * blob.point_step + field.offset], &(*columns[c])[i], sizeof(double));
  }
  return blob;
}

}  // namespace

Coordinates read_pcl_file(const std::string& path) {
  const QuietPcl quiet;
  const std::string where = "cloud '" + path + "': ";
  try {
    return extension_of(path) == "pcd" ? read_pcd(path, where) : read_ply(path, where);
  } catch (const Error&) {
    throw;
  } catch (const std::exception& error) {
    throw Error(where + damaged + " (" + error.what() + ")");
  }
}

void write_pcl_file(const Coordinates& points, const std::string& path) {
  const QuietPcl quiet;
  const pcl::PCLPointCloud2 blob = blob_of(points);
  const Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  const Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  const int status = extension_of(path) == "pcd"
                         ? pcl::PCDWriter().writeBinary(path, blob, origin, orientation)
                         : pcl::PLYWriter().writeBinary(path, blob, origin, orientation, false);
  if (status < 0) throw Error("cloud '" + path + "': cannot be written");
}

}  // namespace aeolian
