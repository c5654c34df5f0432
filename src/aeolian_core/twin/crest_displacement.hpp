#pragma once

#include <vector>

#include "aeolian_core/measure/directional_lines.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

namespace layer {
inline const std::string displacement = "displacement";  ///< of crests along the wind [m]
}  // namespace layer

/// How far crests are from where they are on another surface, place by place along the wind.
struct CrestDisplacement {
  int across = 0;                    ///< number of windows along the wind
  int up = 0;                        ///< and across it
  double hop = 0;                    ///< from window to window along the wind [m]
  double hop_across = 0;             ///< and across it [m]
  std::vector<double> displacement;  ///< window by window, downwind positive; NaN where no match is found [m]
  double median = 0;                 ///< [m]; NaN without any window
  double spread = 0;                 ///< 1.4826 median deviation of the windows from it [m]
};

/// Local displacement of `later` from `earlier` within half a wavelength to both sides, in windows of two
/// wavelengths along and across the wind (all lines of fewer) that overlap by half: the lag of the highest
/// correlation, refined by a parabola, where that exceeds 0.5. `wavelength` in [m].
CrestDisplacement crest_displacement(const DirectionalLines& earlier, const DirectionalLines& later,
                                     double cell, double wavelength);

/// The displacement of the nearest window for each cell of the grid whose lines were compared along
/// `direction` [rad]; unknown beyond the windows.
HeightMap::Layer displacement_layer(const CrestDisplacement& field, const GridGeometry& geometry,
                                    double direction);

}  // namespace aeolian
