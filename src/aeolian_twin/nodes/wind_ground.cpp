#include "aeolian_twin/nodes/wind_ground.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace aeolian {
namespace {

/// Standard deviation of the Gaussian that keeps half of a wave of length one, as wind_relief() does.
constexpr double sigma_of_wave = 0.18739;  // sqrt(2 ln 2)/(2 pi)
constexpr double reach = 3;                // standard deviations
constexpr double least_cells = 4;          ///< as there

/// Cells of one axis about a place, and their weights.
struct Near {
  Near(double place, int n, double sigma)
      : first(std::max(0, static_cast<int>(std::ceil(place - reach * sigma)))) {
    const int last = std::min(n - 1, static_cast<int>(std::floor(place + reach * sigma)));
    for (int i = first; i <= last; ++i)
      weights.push_back(std::exp(-0.5 * (i - place) * (i - place) / (sigma * sigma)));
  }
  int first;
  std::vector<double> weights;
};

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
  const double sigma = sigma_of_wave * std::max(shortest_ / extent_.cell(), least_cells);
  const Near across((x - extent_.origin_x()) / extent_.cell() - 0.5, extent_.nx(), sigma);
  const Near up((y - extent_.origin_y()) / extent_.cell() - 0.5, extent_.ny(), sigma);
  const HeightMap::Layer& elevation = map_.layer(layer::elevation);
  double sum = 0;
  double weights = 0;
  for (std::size_t j = 0; j < up.weights.size(); ++j) {
    const float* row = &elevation[extent_.index(across.first, up.first + static_cast<int>(j))];
    for (std::size_t i = 0; i < across.weights.size(); ++i) {
      if (!std::isfinite(row[i])) continue;
      const double weight = across.weights[i] * up.weights[j];
      sum += weight * static_cast<double>(row[i]);
      weights += weight;
    }
  }
  return sum / weights;
}

}  // namespace aeolian
