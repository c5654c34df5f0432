#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Heights of a plane through the origin.
inline HeightMap::Layer sloping_plane(const GridGeometry& grid, double slope_x, double slope_y) {
  HeightMap::Layer values(grid.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const CellIndex cell = grid.cell_at(i);
    values[i] = static_cast<float>(slope_x * grid.x(cell.x) + slope_y * grid.y(cell.y));
  }
  return values;
}

}  // namespace aeolian
