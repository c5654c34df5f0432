#pragma once

#include <optional>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// The grid of a range of cells. Throws Error for a range that is empty or reaches beyond the grid.
GridGeometry part_of(const GridGeometry& whole, const CellRange& range);

/// A range of cells of a layer on a grid. Throws Error for a range that is empty or reaches beyond the grid.
HeightMap::Layer part_of(const GridGeometry& whole, const HeightMap::Layer& values, const CellRange& range);

/// All layers of a range of cells, as a map. Throws Error for a range that is empty or reaches beyond the
/// map.
HeightMap submap(const HeightMap& map, const CellRange& range);

/// The cells of `whole` that `part` consists of; nothing unless its cells have the same size and its borders
/// lie on theirs, each to a hundredth of a cell, and all of it is inside.
std::optional<CellRange> range_within(const GridGeometry& part, const GridGeometry& whole);

/// Writes the layers of a part that the whole has, too, over the cells that the part covers. Throws Error
/// when the range has not as many cells as the part or reaches beyond the whole.
void paste(const HeightMap& part, const CellRange& at, HeightMap& whole);

}  // namespace aeolian
