#pragma once

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// How many cells are side by side in a length [m]: one or more.
int cells_within(const GridGeometry& geometry, double length);

/// The grid of blocks of factor x factor cells from the same origin; the last ones may reach beyond the map.
GridGeometry thinned(const GridGeometry& geometry, int factor);

/// What resample() gives on the thinned grid, up to rounding, for a range of blocks only: the mean of the
/// known cells of each, unknown where less than half of a block is known. `result` has a value for each
/// block.
void thin(const GridGeometry& geometry, const HeightMap::Layer& values, int factor, const CellRange& blocks,
          HeightMap::Layer& result);

/// The blocks that hold a cell of the active tiles, as tiles of the thinned grid.
TileMask thinned(const TileMask& tiles, const GridGeometry& geometry, int factor);

}  // namespace aeolian
