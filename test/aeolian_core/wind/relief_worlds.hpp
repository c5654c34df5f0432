#pragma once

#include <cmath>
#include <functional>

#include "aeolian_core/wind/terrain_wind.hpp"

namespace aeolian {

/// Ground whose height is known at every point, with the origin in the middle of the map.
inline HeightMap world(int nx, int ny, double cell, const std::function<double(double, double)>& height) {
  HeightMap map(GridGeometry(-0.5 * nx * cell, -0.5 * ny * cell, cell, nx, ny));
  HeightMap::Layer& z = map.add(layer::elevation, 0);
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      z[map.geometry().index(x, y)] = static_cast<float>(height(map.geometry().x(x), map.geometry().y(y)));
  return map;
}

/// A ridge without end, across x.
inline HeightMap ridge(int nx, double cell, const std::function<double(double)>& height) {
  return world(nx, 1, cell, [&](double x, double) { return height(x); });
}

/// Hills of height H and half-width L at half height.
inline double agnesi(double x, double h, double l) { return h * l * l / (x * x + l * l); }
inline double gaussian(double r, double h, double l) { return h * std::exp(-M_LN2 * r * r / (l * l)); }
inline double cosine_bump(double x, double h, double l) {
  return std::abs(x) < 2 * l ? 0.5 * h * (1 + std::cos(0.5 * M_PI * x / l)) : 0;
}

/// A lee on which nothing separates.
constexpr LeeBubble attached{1e6, 0.2};

/// A barchan's middle section: a stoss of `rise` over `length`, a slip face of 32 degrees.
inline double dune(double x, double rise, double length) {
  if (x < -length || x > rise / std::tan(32 * M_PI / 180)) return 0;
  return x < 0 ? rise * (1 - std::cos(M_PI * (x + length) / length)) / 2
               : rise - x * std::tan(32 * M_PI / 180);
}

/// Askervein's height and half-width along the wind (from its inner depth of 11.8 m by Jackson & Hunt's
/// formula), twice as wide across, over its roughness of 0.03 m.
constexpr double askervein_roughness = 0.03;
inline HeightMap askervein_like(double cell, double length = 3000) {
  const int n = static_cast<int>(length / cell) / 2 * 2 + 1;
  return world(n, n, cell, [](double x, double y) { return gaussian(std::hypot(x, 0.5 * y), 116, 220); });
}

}  // namespace aeolian
