#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Which of two forecasts of a surface was nearer to it: the mean over squares of 5 cm, within which errors
/// are alike, of the second's square error less the first's, in standard errors of that mean. Positive: the
/// first was better; beyond 2 that is hardly chance. Zero where it cannot be told: fewer than eight squares
/// of which half is known, or maps on different grids. Maps have the layer elevation.
double advantage(const HeightMap& first, const HeightMap& second, const HeightMap& measured);

}  // namespace aeolian
