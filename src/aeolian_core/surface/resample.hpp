#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// All layers of a map on another grid. Finer or equal cells: bilinear between cell centres, unknown where
/// one of the cells that carry weight is. Coarser cells: area-weighted mean of the known part, unknown where
/// less than half of the cell's area is known. Conserves the volume of a fully known map under refinement of
/// aligned grids by an integer and under coarsening.
HeightMap resample(const HeightMap& map, const GridGeometry& target);

/// Bilinear value of one layer at a point [m]; NaN outside or beside unknown cells. Within half a cell of the
/// border the outermost cell's value is used.
double sample(const GridGeometry& geometry, const HeightMap::Layer& values, double x, double y);

}  // namespace aeolian
