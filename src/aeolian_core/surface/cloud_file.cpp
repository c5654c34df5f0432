#include "aeolian_core/surface/cloud_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/cloud_text.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/geotiff.hpp"
#include "aeolian_core/surface/pcl_file.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

/// Beyond this a float resolves worse than 0.06 mm, and the cloud gets an origin of its own [m].
constexpr double large_coordinate = 1000;

bool is_text(const std::string& extension) {
  return extension == "xyz" || extension == "csv" || extension == "txt";
}

bool is_finite(const Coordinates& points, std::size_t i) {
  return std::isfinite(points.x[i]) && std::isfinite(points.y[i]) && std::isfinite(points.z[i]);
}

std::vector<double> absolute(double origin, const std::vector<float>& values) {
  std::vector<double> result(values.size());
  std::transform(values.begin(), values.end(), result.begin(),
                 [origin](float value) { return origin + static_cast<double>(value); });
  return result;
}

/// The cloud about its first finite point when coordinates are large; throws Error when no point is finite.
PointCloud shifted(const Coordinates& points, const std::string& where) {
  PointCloud cloud;
  bool known = false;
  bool large = false;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    if (!is_finite(points, i)) continue;
    if (!known) {
      cloud.origin_x = std::round(points.x[i]);
      cloud.origin_y = std::round(points.y[i]);
      cloud.origin_z = std::round(points.z[i]);
      known = true;
    }
    const double largest = std::max({std::abs(points.x[i]), std::abs(points.y[i]), std::abs(points.z[i])});
    large = large || largest > large_coordinate;
  }
  if (!known) throw Error(where + "has no finite point among " + std::to_string(points.x.size()));
  if (!large) cloud.origin_x = cloud.origin_y = cloud.origin_z = 0;
  cloud.reserve(points.x.size());
  constexpr float nan = HeightMap::unknown;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    if (is_finite(points, i))
      cloud.push_back(static_cast<float>(points.x[i] - cloud.origin_x),
                      static_cast<float>(points.y[i] - cloud.origin_y),
                      static_cast<float>(points.z[i] - cloud.origin_z));
    else
      cloud.push_back(nan, nan, nan);
  }
  return cloud;
}

Coordinates centres_of_known_cells(const HeightMap& map, const std::string& layer) {
  const GridGeometry& geometry = map.geometry();
  const HeightMap::Layer& values = map.layer(layer);
  Coordinates points;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    const CellIndex cell = geometry.cell_at(i);
    points.x.push_back(geometry.x(cell.x));
    points.y.push_back(geometry.y(cell.y));
    points.z.push_back(static_cast<double>(values[i]));
  }
  return points;
}

Coordinates finite_points(const PointCloud& cloud) {
  Coordinates points{absolute(cloud.origin_x, cloud.x), absolute(cloud.origin_y, cloud.y),
                     absolute(cloud.origin_z, cloud.z)};
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    if (!is_finite(points, i)) continue;
    points.x[kept] = points.x[i];
    points.y[kept] = points.y[i];
    points.z[kept++] = points.z[i];
  }
  for (std::vector<double>* column : {&points.x, &points.y, &points.z}) column->resize(kept);
  return points;
}

std::string to_text(const Coordinates& points, bool csv) {
  const char separator = csv ? ',' : ' ';
  std::string text = csv ? "x,y,z\n" : "";
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    append_number(text, points.x[i]);
    text += separator;
    append_number(text, points.y[i]);
    text += separator;
    append_number(text, points.z[i]);
    text += '\n';
  }
  return text;
}

}  // namespace

PointCloud read_cloud(const std::string& path) {
  const std::string where = "cloud '" + path + "': ";
  const std::string extension = extension_of(path);
  if (!std::filesystem::is_regular_file(path)) throw Error(where + "there is no such file");
  if (is_text(extension)) return shifted(read_cloud_text(path), where);
  if (extension == "pcd" || extension == "ply") return shifted(read_pcl_file(path), where);
  if (extension == "tif" || extension == "tiff") {
    const HeightMap map = read_geotiff(path);
    return shifted(centres_of_known_cells(map, map.names().front()), where);
  }
  if (extension == "las" || extension == "laz")
    throw Error(where + "LAS and LAZ cannot be read (no Debian library does), convert it to XYZ");
  throw Error(where + "format is '" + extension + "', must be pcd, ply, xyz, csv, txt, tif or tiff");
}

void write_cloud(const PointCloud& cloud, const std::string& path) {
  const std::string extension = extension_of(path);
  const bool binary = extension == "pcd" || extension == "ply";
  if (!binary && !is_text(extension))
    throw Error("cloud '" + path + "': format is '" + extension + "', must be pcd, ply, xyz, csv or txt");
  const Coordinates points = finite_points(cloud);
  if (points.x.empty()) throw Error("cloud '" + path + "': has no finite point to write");
  if (binary)
    write_atomically(path, [&](const std::string& temporary) { write_pcl_file(points, temporary); });
  else
    write_text_atomically(path, to_text(points, extension == "csv"));
}

PointCloud to_cloud(const HeightMap& map, const std::string& layer) {
  return shifted(centres_of_known_cells(map, layer), "layer '" + layer + "': ");
}

}  // namespace aeolian
