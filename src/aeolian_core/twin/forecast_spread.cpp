#include "aeolian_core/twin/forecast_spread.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

/// Of the members at each cell; unknown where one of them is.
HeightMap::Layer scatter(const std::vector<const HeightMap::Layer*>& members) {
  const auto count = static_cast<double>(members.size());
  HeightMap::Layer result(members.front()->size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double first = (*members.front())[i];
    double sum = 0;
    double square = 0;
    for (const HeightMap::Layer* member : members) {
      const double off = (*member)[i] - first;
      sum += off;
      square += off * off;
    }
    result[i] = static_cast<float>(std::max(0.0, square - sum * sum / count) / std::max(1.0, count - 1));
  }
  return result;
}

}  // namespace

HeightMap::Layer spread_of(const std::vector<const HeightMap::Layer*>& members, const GridGeometry& geometry,
                           double model_error, const HeightMap& start) {
  const HeightMap::Layer coarse = filled(geometry, scatter(members));
  const GridGeometry& fine = start.geometry();
  HeightMap::Layer spread = coarse;
  if (geometry != fine) {
    HeightMap map(geometry);
    map.add(layer::variance, coarse);
    spread = resample(map, fine).layer(layer::variance);
  }
  const HeightMap::Layer& elevation = start.layer(layer::elevation);
  for (std::size_t i = 0; i < spread.size(); ++i)
    spread[i] =
        std::isfinite(elevation[i])
            ? static_cast<float>(std::sqrt(static_cast<double>(spread[i]) + model_error * model_error))
            : HeightMap::unknown;
  return spread;
}

}  // namespace aeolian
