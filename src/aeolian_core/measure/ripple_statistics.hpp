#pragma once

#include <optional>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Ripples of a map seen along one direction. NaN where the map has none that can be told from noise.
struct RippleStatistics {
  double wavelength = 0;    ///< along the direction [m]
  double height = 0;        ///< trough to crest: 2 sqrt(2) standard deviations of the detrended surface [m]
  double index = 0;         ///< wavelength / height
  double stoss_slope = 0;   ///< median of the rising part, upwind side [rad]
  double lee_slope = 0;     ///< median of the falling part, downwind side [rad, positive]
  double significance = 0;  ///< share of the variance in the spectral peak, 0 to 1
};

/// Statistics along `direction` (radians, counter-clockwise from east, the way the wind blows to). The plane
/// of best fit is removed first. The wavelength is the first maximum of the autocorrelation along the
/// direction after its first minimum, refined by a parabola; its absence (or a correlation there below 0.1)
/// gives NaN, as do maps shorter than two wavelengths.
RippleStatistics ripple_statistics(const GridGeometry& geometry, const HeightMap::Layer& elevation,
                                   double direction);

/// How far the pattern of `later` has moved from that of `earlier` along `direction` [m]: the maximum of
/// their cross-correlation within +-max_shift, to a fraction of a cell. Nothing when no maximum inside
/// exceeds a correlation of 0.2.
std::optional<double> pattern_displacement(const GridGeometry& geometry, const HeightMap::Layer& earlier,
                                           const HeightMap::Layer& later, double direction, double max_shift);

}  // namespace aeolian
