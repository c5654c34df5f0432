#pragma once

#include "aeolian_core/bedforms/wind_frame.hpp"

namespace aeolian {

/// Moves sand down the slopes by the flux q = -D grad h with D = `scale` * `activity` (per cell), conserving
/// volume to rounding, over `duration` [s]; explicit, in as many stages as the strongest activity asks for.
/// Periodic borders are joined, others are walls. `activity` and `height` have their pads filled, and so has
/// the new height. `scratch` is kept between calls.
void apply_slope_flux(const WindFrame& frame, double cell, double scale, const FrameField& activity,
                      double strongest_activity, double duration, FrameField& height, FrameField& scratch);

}  // namespace aeolian
