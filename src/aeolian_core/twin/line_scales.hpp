#pragma once

#include <vector>

#include "aeolian_core/measure/directional_lines.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// Which lengths repeat along the wind (Werner 1987, eq. 5.2), the mean over lines of a map.
struct LineScales {
  std::vector<double> lag;           ///< [m]
  std::vector<double> distribution;  ///< mean 1
  Figure dominant;                   ///< its first maximum after its first minimum [m], NaN without one
};

/// Of up to 24 lines, each where it is known longest and over at least 2 `lags`, for lags of one cell to
/// `lags` cells. `alike`: the difference of heights that still counts as alike [m]. The standard error of the
/// dominant length is that of a jackknife over eight groups of lines, NaN for fewer than eight. Empty without
/// such a line.
LineScales line_scales(const DirectionalLines& lines, double cell, std::size_t lags, double alike);

}  // namespace aeolian
