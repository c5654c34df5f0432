#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The RMS change of the elevation from one map to another of the same grid [m], over means of squares of up
/// to 8 mm, so that noise of cells, which a model smooths away, counts little. Zero where no square is known
/// in both.
double rms_movement(const HeightMap& from, const HeightMap& to);

/// Of the layer `variance`, over the cells where it is known [m^2]; zero without that layer.
double mean_variance(const HeightMap& map);

}  // namespace aeolian
