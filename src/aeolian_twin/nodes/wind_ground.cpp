#include "aeolian_twin/nodes/wind_ground.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

/// Half the side of a square whose mean smooths as wind_relief() does a wave of length one: both keep half
/// of it in a Gaussian's measure, sqrt(2 ln 2)/(2 pi) sqrt(3).
constexpr double half_side = 0.3246;
constexpr double least_cells = 4;  ///< as wind_relief()

}  // namespace

void WindGround::take(const HeightMap& map) {
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  double sum = 0;
  for (const float z : elevation)
    if (std::isfinite(z)) sum += static_cast<double>(z);
  const std::size_t known = count_known(elevation);
  mean_ = known > 0 ? sum / static_cast<double>(known) : 0;
  known_ = known > 0;
  extent_ = map.geometry();
  if (map_.geometry() != extent_) map_ = HeightMap(extent_);
  map_.add(layer::elevation, elevation);
}

bool WindGround::is_known(double x, double y) const {
  const auto cell = extent_.find(x, y);
  return cell && std::isfinite(map_.layer(layer::elevation)[extent_.index(*cell)]);
}

double WindGround::at(double x, double y) const {
  if (!is_known(x, y)) return mean_;
  const double reach = half_side * std::max(shortest_, least_cells * extent_.cell());
  const auto cell = [&](double length) { return static_cast<int>(std::floor(length / extent_.cell())); };
  const int x0 = std::max(0, cell(x - reach - extent_.origin_x()));
  const int x1 = std::min(extent_.nx() - 1, cell(x + reach - extent_.origin_x()));
  const int y0 = std::max(0, cell(y - reach - extent_.origin_y()));
  const int y1 = std::min(extent_.ny() - 1, cell(y + reach - extent_.origin_y()));
  const HeightMap::Layer& elevation = map_.layer(layer::elevation);
  double sum = 0;
  std::size_t count = 0;
  for (int iy = y0; iy <= y1; ++iy)
    for (int ix = x0; ix <= x1; ++ix) {
      const float z = elevation[extent_.index(ix, iy)];
      if (!std::isfinite(z)) continue;
      sum += static_cast<double>(z);
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : mean_;
}

}  // namespace aeolian
