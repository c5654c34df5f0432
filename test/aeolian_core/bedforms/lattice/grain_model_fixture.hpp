#pragma once

#include <cmath>

#include "aeolian_core/bedforms/bed_model.hpp"

namespace aeolian {

/// A map of sand and a wind for the tests of models that keep grains.
struct GrainModelFixture {
  static HeightMap rippled(int nx = 48, int ny = 32) {
    const GridGeometry g(500000, 4e6, 0.002, nx, ny);
    HeightMap map(g);
    HeightMap::Layer& h = map.add(layer::elevation, 0.0F);
    for (int y = 0; y < ny; ++y)
      for (int x = 0; x < nx; ++x)
        h[g.index(x, y)] = static_cast<float>(12.3 + 0.002 * std::sin(4 * M_PI * x / nx) +
                                              0.001 * std::cos(2 * M_PI * y / ny));
    return map;
  }
  static Forcing wind(double direction = 0) {
    Forcing forcing;
    forcing.direction = direction;
    forcing.friction_velocity = 0.45;
    forcing.impact_angle = 0.2;
    forcing.grain.diameter = 0.0004;
    const double side = forcing.grain.effective_diameter();
    forcing.ejection_rate = 1e-4 / (side * side * side);  // 0.1 mm/s
    forcing.reptation_length = 0.008;
    return forcing;
  }
  static double volume(const HeightMap& map) {
    double sum = 0;
    for (const float h : map.layer(layer::elevation)) sum += static_cast<double>(h) - 12.3;
    return sum * map.geometry().cell() * map.geometry().cell();
  }
  /// Of the map's floats: half a unit in the last place of one cell.
  static double rounding(const HeightMap& map) {
    return 1e-6 * map.geometry().cell() * map.geometry().cell();
  }
};

}  // namespace aeolian
