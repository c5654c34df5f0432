#include "aeolian_core/twin/bed_movement.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

constexpr double side = 0.008;  // of a square [m]

/// Elevations as means over squares of the grid's cells.
HeightMap::Layer means(const HeightMap& map) {
  const GridGeometry& g = map.geometry();
  const int factor = std::max(1, static_cast<int>(std::floor(side / g.cell() * (1 + 1e-9))));
  HeightMap elevation(g);
  elevation.add(layer::elevation, map.layer(layer::elevation));
  if (factor == 1) return elevation.layer(layer::elevation);
  const auto count = [factor](int cells) { return (cells + factor - 1) / factor; };
  const GridGeometry squares(g.origin_x(), g.origin_y(), factor * g.cell(), count(g.nx()), count(g.ny()));
  return resample(elevation, squares).layer(layer::elevation);
}

}  // namespace

double rms_movement(const HeightMap& from, const HeightMap& to) {
  const HeightMap::Layer before = means(from);
  const HeightMap::Layer after = means(to);
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double change = static_cast<double>(after[i]) - static_cast<double>(before[i]);
    if (!std::isfinite(change)) continue;
    sum += change * change;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

double mean_variance(const HeightMap& map) {
  if (!map.has(layer::variance)) return 0;
  double sum = 0, count = 0;
  for (const float variance : map.layer(layer::variance)) {
    if (!std::isfinite(variance)) continue;
    sum += static_cast<double>(variance);
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

}  // namespace aeolian
