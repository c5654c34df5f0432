#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// A map on a grid that it should share: as it is when the two agree to a millionth of a cell (messages hold
/// centres of maps, which round), resampled otherwise.
HeightMap on_grid(const HeightMap& map, const GridGeometry& target);

}  // namespace aeolian
