#pragma once

#include <vector>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The standard deviation [m] of a prediction on the grid of `start`: of the members' elevations about their
/// mean, and of the model's own error `model_error` [m]. Members are on a grid of their own, interpolated
/// between its cells. Unknown where the elevation of the start is.
HeightMap::Layer spread_of(const std::vector<const HeightMap::Layer*>& members, const GridGeometry& geometry,
                           double model_error, const HeightMap& start);

}  // namespace aeolian
