#pragma once

#include <vector>

#include "aeolian_core/bedforms/wind_frame.hpp"

namespace aeolian {

/// Moves sand down the slopes by the flux q = -D grad h with D = `scale` * `activity` (per cell), conserving
/// volume to rounding, over `duration` [s]; explicit, in as many substeps as its stability asks for.
/// `periodic` borders are joined, others are walls. Heights and activity are indexed as the frame says;
/// `scratch` is kept between calls.
void apply_slope_flux(const WindFrame& frame, double cell, double scale, const std::vector<double>& activity,
                      double duration, std::vector<double>& height, std::vector<double>& scratch);

/// Spreads values across the wind with a standard deviation of `sigma` rows, conserving their sum to
/// rounding; borders as above.
void spread_across(const WindFrame& frame, double sigma, std::vector<double>& values,
                   std::vector<double>& scratch);

}  // namespace aeolian
