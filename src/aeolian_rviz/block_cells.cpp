#include "aeolian_rviz/block_cells.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

/// The mean of the nearest known heights along row, column and diagonals, the nearer the heavier; NaN when
/// none is near.
float extended(const GridGeometry& geometry, const HeightMap::Layer& values, int x, int y) {
  double sum = 0;
  double weights = 0;
  for (const auto& [dx, dy] : {CellIndex{-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}})
    for (int d = 1; d <= extension_cells; ++d) {
      const CellIndex cell{x + d * dx, y + d * dy};
      if (!geometry.contains(cell)) break;
      const float value = values[geometry.index(cell)];
      if (!std::isfinite(value)) continue;
      sum += static_cast<double>(value) / d;
      weights += 1.0 / d;
      break;
    }
  return weights > 0 ? static_cast<float>(sum / weights) : HeightMap::unknown;
}

}  // namespace

void BlockCells::take(const GridGeometry& geometry, const HeightMap::Layer& values, const CellRange& block,
                      const CellRange& range, double base) {
  for (int y = range.y0; y < range.y1; ++y)
    for (int x = range.x0; x < range.x1; ++x) {
      const std::size_t at = index(x - block.x0, y - block.y0);
      float height = values[geometry.index(x, y)];
      const bool known = std::isfinite(height);
      if (!known) height = extended(geometry, values, x, y);
      const bool drawn = std::isfinite(height);
      states[at] = known ? VertexState::known : drawn ? VertexState::extended : VertexState::none;
      heights[at] = drawn ? static_cast<float>(static_cast<double>(height) - base) : 0.0F;
    }
}

BlockGrid::BlockGrid(const GridGeometry& geometry) {
  constexpr int quads = block_vertices - 1;
  const auto count = [](int cells) { return std::max((cells - 2) / quads + 1, 1); };
  across = count(geometry.nx());
  along = count(geometry.ny());
  for (int by = 0; by < along; ++by)
    for (int bx = 0; bx < across; ++bx)
      ranges.push_back({bx * quads, std::min(bx * quads + block_vertices, geometry.nx()), by * quads,
                        std::min(by * quads + block_vertices, geometry.ny())});
}

std::optional<CellRange> changed_part(const TileMask& changed, const CellRange& block) {
  std::optional<CellRange> part;
  constexpr int tile = TileMask::tile_cells;
  const int tx0 = std::max(block.x0 - extension_cells, 0) / tile;
  const int ty0 = std::max(block.y0 - extension_cells, 0) / tile;
  const int tx1 = std::min((block.x1 - 1 + extension_cells) / tile + 1, changed.tiles_x());
  const int ty1 = std::min((block.y1 - 1 + extension_cells) / tile + 1, changed.tiles_y());
  for (int ty = ty0; ty < ty1; ++ty)
    for (int tx = tx0; tx < tx1; ++tx) {
      if (!changed.tile(tx, ty)) continue;
      const CellRange cells = changed.range(tx, ty);
      const CellRange reached{
          std::max(cells.x0 - extension_cells, block.x0), std::min(cells.x1 + extension_cells, block.x1),
          std::max(cells.y0 - extension_cells, block.y0), std::min(cells.y1 + extension_cells, block.y1)};
      if (reached.x0 >= reached.x1 || reached.y0 >= reached.y1) continue;
      if (!part) {
        part = reached;
        continue;
      }
      part = CellRange{std::min(part->x0, reached.x0), std::max(part->x1, reached.x1),
                       std::min(part->y0, reached.y0), std::max(part->y1, reached.y1)};
    }
  return part;
}

}  // namespace aeolian
