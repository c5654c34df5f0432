#include "aeolian_twin/nodes/drawn_crests.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/measure/ripple_crests.hpp"

namespace aeolian {
namespace {

// Of the map's length.
constexpr double line_width = 0.004;
constexpr double crest_lift = 0.005;  // over the noise and over blocks of cells whose mean is drawn

}  // namespace

visualization_msgs::Marker draw_crests(const DrawnLayers& layers, const SurfaceLook& look, double direction,
                                       const std_msgs::Header& header) {
  const GridGeometry& grid = layers.geometry;
  const double lowest = lowest_height(layers.heights);
  visualization_msgs::Marker lines;
  lines.header = header;
  lines.ns = "crests";
  lines.type = visualization_msgs::Marker::LINE_LIST;
  lines.pose.position.x = grid.origin_x() + look.offset[0];
  lines.pose.position.y = grid.origin_y() + look.offset[1];
  lines.pose.position.z = lowest + look.offset[2] + crest_lift * grid.length_x();
  lines.pose.orientation.w = 1;
  lines.scale.x = line_width * grid.length_x();
  lines.color.r = 0;
  lines.color.g = 0.35F;
  lines.color.b = 0.85F;
  lines.color.a = 1;

  const auto point = [&](const Eigen::Vector2d& place) {
    geometry_msgs::Point result;
    result.x = place.x() - grid.origin_x();
    result.y = place.y() - grid.origin_y();
    const int x = std::clamp(static_cast<int>(std::floor(result.x / grid.cell())), 0, grid.nx() - 1);
    const int y = std::clamp(static_cast<int>(std::floor(result.y / grid.cell())), 0, grid.ny() - 1);
    const float height = layers.heights[grid.index(x, y)];
    if (std::isfinite(height)) result.z = (static_cast<double>(height) - lowest) * look.exaggeration;
    return result;
  };
  for (const CrestLine& crest : find_crests(grid, layers.heights, direction).crests) {
    for (std::size_t i = 1; i < crest.points.size(); ++i) {
      lines.points.push_back(point(crest.points[i - 1]));
      lines.points.push_back(point(crest.points[i]));
    }
  }
  lines.action = lines.points.empty() ? visualization_msgs::Marker::DELETE : visualization_msgs::Marker::ADD;
  return lines;
}

}  // namespace aeolian
