#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <Eigen/Core>

#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"
#include "aeolian_core/bedforms/wrapped.hpp"

namespace aeolian {

/// The surface at a place between four cells' centres, bilinear.
struct SurfacePatch {
  float height, slope_x, slope_y;
};

/// The square between four cells' centres in which a place lies. `x`, `y` in cells from the centre of cell
/// (0, 0), on the ring of a periodic bed; beyond the centres of an open one's outer cells the surface is
/// level.
struct SurfaceSquare {
  SurfaceSquare(const ErodibleBed& bed, float x, float y) {
    const float cx = std::clamp(x, 0.0F, bed.last_x());
    const float cy = std::clamp(y, 0.0F, bed.last_y());
    const int ix = static_cast<int>(cx);
    const int iy = static_cast<int>(cy);
    tx = cx - static_cast<float>(ix);
    ty = cy - static_cast<float>(iy);
    south = bed.surface() + std::ptrdiff_t{iy} * bed.stride() + ix;
    north = south + bed.stride();
    low = south[0] + tx * (south[1] - south[0]);
    high = north[0] + tx * (north[1] - north[0]);
  }
  float height() const { return low + ty * (high - low); }

  float tx, ty;  ///< of the place in the square
  const float* south;
  const float* north;
  float low, high;  ///< of the southern and northern side beside the place
};

inline SurfacePatch patch_at(const ErodibleBed& bed, float x, float y) {
  const SurfaceSquare s(bed, x, y);
  const auto cell = static_cast<float>(bed.geometry().cell());
  return {s.height(), ((1 - s.ty) * (s.south[1] - s.south[0]) + s.ty * (s.north[1] - s.north[0])) / cell,
          (s.high - s.low) / cell};
}

/// Its height alone.
inline float height_at(const ErodibleBed& bed, float x, float y) { return SurfaceSquare(bed, x, y).height(); }

/// Height of the cell that lies so far from another; beyond an open border that of the outermost.
inline float height_beside(const ErodibleBed& bed, CellIndex c, int dx, int dy) {
  const int nx = bed.geometry().nx();
  const int ny = bed.geometry().ny();
  if (bed.periodic()) return bed.height(wrapped(c.x + dx, nx), wrapped(c.y + dy, ny));
  return bed.height(std::clamp(c.x + dx, 0, nx - 1), std::clamp(c.y + dy, 0, ny - 1));
}

/// Rise over run at a cell, east and north: that of its normal, the sum of those of the triangles about it.
/// Slopes within a cell are the noise of single parcels.
inline Eigen::Vector2f slope_at(const ErodibleBed& bed, CellIndex c) {
  const auto twice = static_cast<float>(2 * bed.geometry().cell());
  return {(height_beside(bed, c, 1, 0) - height_beside(bed, c, -1, 0)) / twice,
          (height_beside(bed, c, 0, 1) - height_beside(bed, c, 0, -1)) / twice};
}

/// A place on a periodic bed's ring.
inline float on_ring(float x, int n) {
  const auto length = static_cast<float>(n);
  if (x >= 0 && x < length) return x;
  const float turned = x - length * std::floor(x / length);
  return turned < length ? turned : 0;
}

/// The cell whose centre is nearest; -1 beyond an open border.
inline std::int64_t cell_near(const ErodibleBed& bed, float x, float y) {
  const GridGeometry& g = bed.geometry();
  auto ix = static_cast<int>(std::floor(x + 0.5F));
  auto iy = static_cast<int>(std::floor(y + 0.5F));
  if (bed.periodic()) {
    ix = ix < 0 ? ix + g.nx() : ix >= g.nx() ? ix - g.nx() : ix;
    iy = iy < 0 ? iy + g.ny() : iy >= g.ny() ? iy - g.ny() : iy;
  }
  return g.contains({ix, iy}) ? static_cast<std::int64_t>(g.index(ix, iy)) : -1;
}

}  // namespace aeolian
