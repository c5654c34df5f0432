#pragma once

#include "aeolian_core/bedforms/height_map/impact_sweep.hpp"
#include "aeolian_core/bedforms/height_map/lateral_spread.hpp"
#include "aeolian_core/bedforms/height_map/slope_bias.hpp"

namespace aeolian {

/// What a sweep did to the bed, in flat-bed cells.
struct LaidDown {
  double eroded = 0;  ///< within the grid
  double inflow = 0;  ///< across open borders
  double outflow = 0;
  double strongest = 0;  ///< the largest activity
};

/// Applies a sweep over a step in which a flat bed loses `depth` [m]: gives what lines lost and gained to the
/// rows beside them, deposition spread across the wind. `activity` becomes the deposition, or zero where that
/// is negative. Both have their pads filled. `open` is that of hard ground or null. Only active patches are
/// worked on; `active` grows by those that the spread reaches. Then `bias`, unless null, acts on the
/// activity.
LaidDown lay_down(const WindFrame& frame, const ImpactSweep& sweep, const LateralSpread& spread, double depth,
                  const FrameField* open, const SlopeBias* bias, ActivePatches& active, FrameField& bed,
                  FrameField& activity);

}  // namespace aeolian
