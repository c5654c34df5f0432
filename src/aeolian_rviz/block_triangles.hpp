#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_rviz/block_cells.hpp"

namespace aeolian {

/// Level of detail: every 2^level-th vertex of a block is drawn, and its last row and column.
constexpr int coarsest_level = 6;
/// Of a block with holes: the quads at a rim stand on heights that are extended no further.
constexpr int coarsest_level_at_holes = 3;
static_assert(1 << coarsest_level_at_holes <= extension_cells);

/// The coarsest level whose quads are at most `quad_pixels` wide on the screen, 0 when even cells are wider.
int detail_level(double cell_pixels, double quad_pixels);

/// Levels of a block and of those beside it; the block's own where there is none.
struct BlockLevels {
  int own = 0;
  int west = 0;
  int east = 0;
  int south = 0;
  int north = 0;
  friend bool operator==(const BlockLevels& a, const BlockLevels& b) {
    return a.own == b.own && a.west == b.west && a.east == b.east && a.south == b.south && a.north == b.north;
  }
};

/// The corners of the triangles, three indices each, of a block of nx * ny vertices in rows of
/// `block_vertices`. Along an edge to a coarser neighbour the vertices that it lacks are drawn in to those it
/// has, so that no crack opens. Quads without a known cell and triangles with a corner that has no height are
/// left out.
std::vector<std::uint16_t> block_triangles(int nx, int ny, const BlockLevels& levels,
                                           const std::vector<VertexState>& states);

/// How many triangles a block without holes has at a level, its edges not counted as drawn in.
std::size_t count_triangles(int nx, int ny, int level);

}  // namespace aeolian
