#pragma once

#include <vector>

#include "aeolian_core/bedforms/frame_field.hpp"
#include "aeolian_core/surface/grid_geometry.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// Lets every slope steeper than `tan_repose` slide down to it, conserving volume to rounding, by projection
/// (no explicit diffusion). Slopes are taken to the eight neighbours. Only tiles of `active` and those that
/// the slide reaches are visited. `periodic` joins opposite borders; otherwise they are walls. Stops when no
/// slope exceeds tan_repose by more than a thousandth of itself. Returns the volume moved [m^3].
double avalanche(const GridGeometry& geometry, std::vector<double>& height, double tan_repose, bool periodic,
                 TileMask& active);

/// The same for a whole field with pads filled, before and after; only slopes that are too steep and what
/// they reach are visited.
double avalanche(FrameField& height, int stations, double cell, double tan_repose, bool periodic);

}  // namespace aeolian
