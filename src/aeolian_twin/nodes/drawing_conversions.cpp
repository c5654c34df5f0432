#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <sensor_msgs/point_cloud2_iterator.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

/// The heights of a drawing relative to the pose (map corner, lowest height) at which it is drawn.
class Relief {
 public:
  Relief(const HeightMap& map, const Drawing& drawing)
      : values_(map.layer(drawing.layer)), exaggeration_(drawing.exaggeration) {
    if (drawing.colours.size() != values_.size())
      throw Error(fmt::format("drawing: {} colours for {} cells", drawing.colours.size(), values_.size()));
    double low = std::numeric_limits<double>::infinity();
    for (const float v : values_)
      if (std::isfinite(v)) low = std::min(low, static_cast<double>(v));
    lowest_ = std::isfinite(low) ? low : 0;
  }

  bool known(std::size_t cell) const { return std::isfinite(values_[cell]); }
  double lowest() const { return lowest_; }
  double above_lowest(std::size_t cell) const {
    return (static_cast<double>(values_[cell]) - lowest_) * exaggeration_;
  }

 private:
  const HeightMap::Layer& values_;
  double exaggeration_;
  double lowest_ = 0;
};

std_msgs::ColorRGBA to_colour(const Rgb& rgb) {
  std_msgs::ColorRGBA colour;
  colour.r = static_cast<float>(rgb[0]) / 255.0F;
  colour.g = static_cast<float>(rgb[1]) / 255.0F;
  colour.b = static_cast<float>(rgb[2]) / 255.0F;
  colour.a = 1;
  return colour;
}

}  // namespace

sensor_msgs::PointCloud2 to_coloured_cloud(const HeightMap& map, const Drawing& drawing,
                                           const std_msgs::Header& header) {
  const GridGeometry& geometry = map.geometry();
  const Relief relief(map, drawing);
  sensor_msgs::PointCloud2 cloud;
  cloud.header = header;
  cloud.is_dense = 1;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(2, "xyz", "rgb");
  modifier.resize(count_known(map.layer(drawing.layer)));
  sensor_msgs::PointCloud2Iterator<float> xyz(cloud, "x");
  sensor_msgs::PointCloud2Iterator<std::uint8_t> rgb(cloud, "rgb");
  for (std::size_t i = 0; i < geometry.size(); ++i) {
    if (!relief.known(i)) continue;
    const CellIndex cell = geometry.cell_at(i);
    xyz[0] = static_cast<float>(geometry.x(cell.x) + drawing.offset[0]);
    xyz[1] = static_cast<float>(geometry.y(cell.y) + drawing.offset[1]);
    xyz[2] = static_cast<float>(relief.lowest() + relief.above_lowest(i) + drawing.offset[2]);
    const Rgb& colour = drawing.colours[i];
    rgb[0] = colour[2];  // stored as blue, green, red
    rgb[1] = colour[1];
    rgb[2] = colour[0];
    ++xyz;
    ++rgb;
  }
  return cloud;
}

visualization_msgs::Marker to_mesh(const HeightMap& map, const Drawing& drawing,
                                   const std_msgs::Header& header) {
  const GridGeometry& geometry = map.geometry();
  const Relief relief(map, drawing);
  visualization_msgs::Marker mesh;
  mesh.header = header;
  mesh.ns = "surface";
  mesh.type = visualization_msgs::Marker::TRIANGLE_LIST;
  mesh.action = visualization_msgs::Marker::ADD;
  mesh.pose.position.x = geometry.origin_x() + drawing.offset[0];
  mesh.pose.position.y = geometry.origin_y() + drawing.offset[1];
  mesh.pose.position.z = relief.lowest() + drawing.offset[2];
  mesh.pose.orientation.w = 1;
  mesh.scale.x = mesh.scale.y = mesh.scale.z = 1;
  mesh.color.a = 1;

  const auto add_vertex = [&](std::size_t i) {
    const CellIndex cell = geometry.cell_at(i);
    geometry_msgs::Point point;
    point.x = (cell.x + 0.5) * geometry.cell();
    point.y = (cell.y + 0.5) * geometry.cell();
    point.z = relief.above_lowest(i);
    mesh.points.push_back(point);
    mesh.colors.push_back(to_colour(drawing.colours[i]));
  };
  const auto quads = static_cast<std::size_t>(std::max(0, geometry.nx() - 1)) *
                     static_cast<std::size_t>(std::max(0, geometry.ny() - 1));
  mesh.points.reserve(6 * quads);
  mesh.colors.reserve(6 * quads);
  for (int y = 0; y + 1 < geometry.ny(); ++y) {
    for (int x = 0; x + 1 < geometry.nx(); ++x) {
      const std::size_t sw = geometry.index(x, y);
      const std::size_t se = geometry.index(x + 1, y);
      const std::size_t nw = geometry.index(x, y + 1);
      const std::size_t ne = geometry.index(x + 1, y + 1);
      if (!relief.known(sw) || !relief.known(se) || !relief.known(nw) || !relief.known(ne)) continue;
      for (const std::size_t corner : {sw, se, ne, sw, ne, nw}) add_vertex(corner);
    }
  }
  return mesh;
}

}  // namespace aeolian
