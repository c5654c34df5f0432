#include <algorithm>
#include <cmath>
#include <cstring>

#include <sensor_msgs/point_cloud2_iterator.h>

#include "aeolian_twin/nodes/drawn_surface.hpp"

namespace aeolian {

const sensor_msgs::PointCloud2& DrawnCloud::draw(const DrawnLayers& layers, const SurfaceLook& look,
                                                 const TileMask& changed, const std_msgs::Header& header) {
  std::vector<CellRange> ranges = cells_.update(layers, look, changed);
  const auto kept = [&](const CellRange& range) { return has_points_of(layers.heights, range); };
  if (point_of_cell_.size() != layers.heights.size() || !std::all_of(ranges.begin(), ranges.end(), kept)) {
    make_points(layers.heights);
    ranges = {{0, layers.geometry.nx(), 0, layers.geometry.ny()}};
  }
  for (const CellRange& range : ranges) write(layers.heights, range);
  cloud_.header = header;
  return cloud_;
}

bool DrawnCloud::has_points_of(const HeightMap::Layer& heights, const CellRange& range) const {
  for (int y = range.y0; y < range.y1; ++y) {
    for (int x = range.x0; x < range.x1; ++x) {
      const std::size_t i = cells_.geometry().index(x, y);
      if (std::isfinite(heights[i]) != (point_of_cell_[i] >= 0)) return false;
    }
  }
  return true;
}

void DrawnCloud::make_points(const HeightMap::Layer& heights) {
  std::int32_t points = 0;
  point_of_cell_.resize(heights.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
    point_of_cell_[i] = std::isfinite(heights[i]) ? points++ : -1;
  cloud_.is_dense = 1;
  sensor_msgs::PointCloud2Modifier modifier(cloud_);
  modifier.setPointCloud2FieldsByString(2, "xyz", "rgb");
  modifier.resize(static_cast<std::size_t>(points));
}

void DrawnCloud::write(const HeightMap::Layer& heights, const CellRange& range) {
  const GridGeometry& geometry = cells_.geometry();
  const std::array<double, 3>& offset = cells_.look().offset;
  const std::size_t rgb_at = cloud_.fields.back().offset;
  for (int y = range.y0; y < range.y1; ++y) {
    for (int x = range.x0; x < range.x1; ++x) {
      const std::size_t i = geometry.index(x, y);
      if (point_of_cell_[i] < 0) continue;
      std::uint8_t* point = &cloud_.data[static_cast<std::size_t>(point_of_cell_[i]) * cloud_.point_step];
      const std::array<float, 3> xyz{
          static_cast<float>(geometry.x(x) + offset[0]), static_cast<float>(geometry.y(y) + offset[1]),
          static_cast<float>(cells_.lowest() + cells_.drawn_height(heights[i]) + offset[2])};
      std::memcpy(point, xyz.data(), sizeof xyz);
      const Rgb& colour = cells_.colour(i);
      const Rgb as_stored{colour[2], colour[1], colour[0]};
      std::memcpy(point + rgb_at, as_stored.data(), sizeof as_stored);
    }
  }
}

}  // namespace aeolian
