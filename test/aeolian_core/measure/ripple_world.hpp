#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// A surface z(x, y) on a grid.
template <class Surface>
HeightMap::Layer laid_out(const GridGeometry& g, const Surface& surface) {
  HeightMap::Layer layer(g.size());
  for (int iy = 0; iy < g.ny(); ++iy)
    for (int ix = 0; ix < g.nx(); ++ix)
      layer[g.index(ix, iy)] = static_cast<float>(surface(g.x(ix), g.y(iy)));
  return layer;
}

inline void add_noise(HeightMap::Layer& layer, double sigma, std::uint64_t seed) {
  RandomStream random(seed, 0);
  for (float& h : layer) h += static_cast<float>(sigma * random.normal());
}

/// Forgets what is within a radius [m] of some points.
inline void dig_holes(const GridGeometry& g, HeightMap::Layer& layer,
                      const std::vector<std::pair<double, double>>& at, double radius) {
  for (int iy = 0; iy < g.ny(); ++iy)
    for (int ix = 0; ix < g.nx(); ++ix)
      for (const auto& [x, y] : at)
        if (std::hypot(g.x(ix) - x, g.y(iy) - y) < radius) layer[g.index(ix, iy)] = HeightMap::unknown;
}

/// A place where a wave train has one crest more on one side: the phase turns once about it.
struct Dislocation {
  double x, y;
  int sign;
};

/// A train of a wavelength and height whose wave vector points into a direction, with dislocations.
struct Train {
  double wavelength = 0.05;
  double height = 0.05 / 15;
  double direction = 0;
  double phase = 0;  ///< [rad]
  std::vector<Dislocation> dislocations;

  double operator()(double x, double y) const {
    double angle = 2 * M_PI / wavelength * (x * std::cos(direction) + y * std::sin(direction)) - phase;
    for (const Dislocation& d : dislocations) angle += d.sign * std::atan2(y - d.y, x - d.x);
    return 0.5 * height * std::cos(angle);
  }
};

}  // namespace aeolian
