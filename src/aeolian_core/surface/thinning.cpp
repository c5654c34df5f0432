#include "aeolian_core/surface/thinning.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

int cells_within(const GridGeometry& geometry, double length) {
  return std::max(1, static_cast<int>(std::floor(length / geometry.cell() * (1 + 1e-9))));
}

GridGeometry thinned(const GridGeometry& geometry, int factor) {
  const auto blocks = [factor](int cells) { return (cells + factor - 1) / factor; };
  return {geometry.origin_x(), geometry.origin_y(), geometry.cell() * factor, blocks(geometry.nx()),
          blocks(geometry.ny())};
}

void thin(const GridGeometry& geometry, const HeightMap::Layer& values, int factor, const CellRange& blocks,
          HeightMap::Layer& result) {
  const GridGeometry coarse = thinned(geometry, factor);
  for (int by = blocks.y0; by < blocks.y1; ++by) {
    for (int bx = blocks.x0; bx < blocks.x1; ++bx) {
      double sum = 0;
      int known = 0;
      for (int y = by * factor; y < std::min(geometry.ny(), (by + 1) * factor); ++y) {
        for (int x = bx * factor; x < std::min(geometry.nx(), (bx + 1) * factor); ++x) {
          const float value = values[geometry.index(x, y)];
          if (!std::isfinite(value)) continue;
          sum += static_cast<double>(value);
          ++known;
        }
      }
      result[coarse.index(bx, by)] =
          2 * known >= factor * factor ? static_cast<float>(sum / known) : HeightMap::unknown;
    }
  }
}

TileMask thinned(const TileMask& tiles, const GridGeometry& geometry, int factor) {
  TileMask result(thinned(geometry, factor));
  const int wide = TileMask::tile_cells * factor;
  tiles.for_each([&](const CellRange& cells) {
    for (int ty = cells.y0 / wide; ty * wide < cells.y1; ++ty)
      for (int tx = cells.x0 / wide; tx * wide < cells.x1; ++tx) result.set_tile(tx, ty);
  });
  return result;
}

}  // namespace aeolian
