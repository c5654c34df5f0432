#pragma once

#include <cmath>
#include <cstdint>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

inline HeightMap::Layer white_noise(const GridGeometry& grid, double sigma, std::uint64_t seed) {
  RandomStream random(seed, 77);
  HeightMap::Layer z(grid.size());
  for (float& v : z) v = static_cast<float>(sigma * random.normal());
  return z;
}

/// Noise of standard deviation `sigma` that falls off as exp(-|dx| / reach - |dy| / reach), reach in cells:
/// first-order autoregression along rows and columns. The integral of its correlation is (coth(1 / 2
/// reach))^2 cells.
inline HeightMap::Layer correlated_noise(const GridGeometry& grid, double sigma, double reach,
                                         std::uint64_t seed) {
  HeightMap::Layer z = white_noise(grid, sigma, seed);
  const auto keep = static_cast<float>(std::exp(-1 / reach));
  const float add = std::sqrt(1 - keep * keep);
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 1; x < grid.nx(); ++x)
      z[grid.index(x, y)] = keep * z[grid.index(x - 1, y)] + add * z[grid.index(x, y)];
  for (int y = 1; y < grid.ny(); ++y)
    for (int x = 0; x < grid.nx(); ++x)
      z[grid.index(x, y)] = keep * z[grid.index(x, y - 1)] + add * z[grid.index(x, y)];
  return z;
}

inline HeightMap map_of(const GridGeometry& grid, HeightMap::Layer elevation) {
  HeightMap map(grid);
  map.add(layer::elevation, std::move(elevation));
  return map;
}

}  // namespace aeolian
