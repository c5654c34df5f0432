#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// What a vertex of the surface stands on.
enum class VertexState : std::uint8_t {
  none,      ///< no height, nor a known cell near it: no triangle
  extended,  ///< an unknown cell near a known one: the rim's triangles need it
  known,
};

/// Blocks are drawn as squares of so many vertices, one at each cell's centre; neighbours share a row of
/// them.
constexpr int block_vertices = 128;
/// Heights are extended by so many cells into unknown ground.
constexpr int extension_cells = 8;

/// The vertices of a block, rows of `block_vertices`.
struct BlockCells {
  std::vector<float> heights =
      std::vector<float>(block_vertices * block_vertices, 0.0F);  ///< above a base [m]
  std::vector<VertexState> states =
      std::vector<VertexState>(block_vertices * block_vertices, VertexState::none);

  static std::size_t index(int x, int y) { return static_cast<std::size_t>(y * block_vertices + x); }

  /// Takes the heights of a range of the map's cells; `block` is the range of all of the block's cells.
  void take(const GridGeometry& geometry, const HeightMap::Layer& values, const CellRange& block,
            const CellRange& range, double base);
};

/// The ranges of cells of all blocks of a map, row by row; `across` of them make a row.
struct BlockGrid {
  explicit BlockGrid(const GridGeometry& geometry);
  int across = 0;
  int along = 0;
  std::vector<CellRange> ranges;
};

/// The cells of a block whose drawing depends on changed tiles: the smallest range that holds them all.
std::optional<CellRange> changed_part(const TileMask& changed, const CellRange& block);

}  // namespace aeolian
