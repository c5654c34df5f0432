#pragma once

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/wind/wind_volume.hpp"

namespace aeolian::sph {

/// What flows through boxes over a map, about a spacing long, wide and exactly one high, that follow the
/// ground: each face has the wind of its middle. `height(x, y)` of the ground, `wind(x, y, height over it)`.
template <class Height, class Wind>
FaceFlows resampled_flows(const GridGeometry& g, double spacing, int nz, Height&& height, Wind&& wind) {
  const int nx = std::max(1, static_cast<int>(g.length_x() / spacing));
  const int ny = std::max(1, static_cast<int>(g.length_y() / spacing));
  const double dx = g.length_x() / nx;
  const double dy = g.length_y() / ny;
  FaceFlows flows(nx, ny, nz);
  for (int iy = 0; iy <= ny; ++iy)
    for (int ix = 0; ix <= nx; ++ix)
      for (int iz = 0; iz <= nz; ++iz) {
        const double x = g.origin_x() + ix * dx;
        const double y = g.origin_y() + iy * dy;
        const double z = (iz + 0.5) * spacing;
        if (iz < nz && iy < ny) flows.x(ix, iy, iz) = dy * spacing * wind(x, y + 0.5 * dy, z).east;
        if (iz < nz && ix < nx) flows.y(ix, iy, iz) = dx * spacing * wind(x + 0.5 * dx, y, z).north;
        if (ix == nx || iy == ny || iz == 0) continue;  // No air leaves through the ground.
        const double slope_x = (height(x + dx, y + 0.5 * dy) - height(x, y + 0.5 * dy)) / dx;
        const double slope_y = (height(x + 0.5 * dx, y + dy) - height(x + 0.5 * dx, y)) / dy;
        const AirVelocity u = wind(x + 0.5 * dx, y + 0.5 * dy, iz * spacing);
        flows.z(ix, iy, iz) = dx * dy * (u.up - u.east * slope_x - u.north * slope_y);
      }
  return flows;
}

}  // namespace aeolian::sph
