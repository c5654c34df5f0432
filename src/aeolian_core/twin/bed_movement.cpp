#include "aeolian_core/twin/bed_movement.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/surface/thinning.hpp"

namespace aeolian {
namespace {

constexpr double square_side = 0.008;  // of a square [m]

/// Elevations as means over squares of the grid's cells.
HeightMap::Layer means(const HeightMap& map) {
  const GridGeometry& g = map.geometry();
  const int factor = cells_within(g, square_side);
  if (factor == 1) return map.layer(layer::elevation);
  HeightMap elevation(g);
  elevation.add(layer::elevation, map.layer(layer::elevation));
  return resample(elevation, thinned(g, factor)).layer(layer::elevation);
}

/// Of the squares that are known in both [m].
std::vector<double> movements(const HeightMap& from, const HeightMap& to) {
  const HeightMap::Layer before = means(from);
  const HeightMap::Layer after = means(to);
  std::vector<double> changes;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double change = static_cast<double>(after[i]) - static_cast<double>(before[i]);
    if (std::isfinite(change)) changes.push_back(change);
  }
  return changes;
}

}  // namespace

double rms_movement(const HeightMap& from, const HeightMap& to) {
  double sum = 0, count = 0;
  for (const double change : movements(from, to)) {
    sum += change * change;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : 0;
}

double median_movement(const HeightMap& from, const HeightMap& to) {
  std::vector<double> changes = movements(from, to);
  if (changes.empty()) return 0;
  const double shared = median(changes);
  for (double& change : changes) change = std::abs(change - shared);
  return median(std::move(changes));
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
