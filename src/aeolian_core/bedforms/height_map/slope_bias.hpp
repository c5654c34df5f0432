#pragma once

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"

namespace aeolian {

/// Makes the downslope bias of reptation grow with the square of the slope: activity *= 1 + min(8, (slope /
/// doubling slope)^2), slopes being those above the dune-scale surface. On stoss slopes of about 8 degrees
/// all ejecta run downhill (specification of the splash, sec. 3.7), which the bias of gentle slopes misses.
///
/// `activity`, `bed` and `dune` have their pads filled. Returns the strongest activity among active patches.
double stiffen(const WindFrame& frame, double cell, double tan_doubling_slope, const FrameField& dune,
               const FrameField& bed, const ActivePatches& active, FrameField& activity);

}  // namespace aeolian
