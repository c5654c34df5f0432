#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The RMS change of the elevation from one map to another of the same grid [m], over means of squares of up
/// to 8 mm, so that noise of cells, which a model smooths away, counts little. Zero where no square is known
/// in both.
double rms_movement(const HeightMap& from, const HeightMap& to);

/// Half of the squares have moved by more than this [m], the movement that all of them share left out: that
/// of a sensor that has been lifted. A few footprints hardly count, nor does noise, of which a square's mean
/// has a quarter. Zero where no square is known in both.
double median_movement(const HeightMap& from, const HeightMap& to);

/// Of the layer `variance`, over the cells where it is known [m^2]; zero without that layer.
double mean_variance(const HeightMap& map);

}  // namespace aeolian
