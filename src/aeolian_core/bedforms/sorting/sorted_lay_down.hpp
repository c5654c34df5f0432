#pragma once

#include <array>

#include "aeolian_core/bedforms/height_map/lateral_spread.hpp"
#include "aeolian_core/bedforms/sorting/active_layer.hpp"
#include "aeolian_core/bedforms/sorting/sorted_sweep.hpp"

namespace aeolian {

/// What a sweep did to the bed, of each size, in flat-bed cells of fine grains.
struct SortedLaidDown {
  std::array<double, SortedSweep::sizes> eroded{};  ///< within the grid
  std::array<double, SortedSweep::sizes> inflow{};  ///< across open borders
  std::array<double, SortedSweep::sizes> outflow{};
  double strongest = 0;  ///< the largest activity
};

/// Applies a sweep over a step in which a flat bed of fine grains loses `depth` [m]: bed and active layer
/// lose of each size what was struck of their surface, and gain what came down, spread across the wind by
/// that size's own hops. `activity` becomes the deposition, each size's by its hops relative to fine ones.
/// All have their pads filled.
SortedLaidDown lay_down(const WindFrame& frame, const SortedSweep& sweep,
                        const std::array<LateralSpread, SortedSweep::sizes>& spread, double depth,
                        double coarse_hop_ratio, FrameField& bed, ActiveLayer& layer, FrameField& activity);

}  // namespace aeolian
