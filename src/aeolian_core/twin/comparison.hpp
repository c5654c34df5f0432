#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// A predicted surface scored against a measured one. Differences are predicted minus measured; NaN where a
/// number cannot be had. Lengths in metres.
struct Comparison {
  std::size_t cells = 0;  ///< known in all surfaces compared
  double bias = 0;
  double rmse = 0;
  double nmad = 0;                     ///< 1.4826 median(|d - median(d)|) (Hoehle & Hoehle 2009)
  double volume_change_measured = 0;   ///< since the start [m^3]
  double volume_change_predicted = 0;  ///< [m^3]
  double wavelength_measured = 0;
  double wavelength_predicted = 0;
  double height_measured = 0;
  double height_predicted = 0;
  double displacement_measured = 0;  ///< of the pattern since the start, along the wind
  double displacement_predicted = 0;
  double rmse_persistence = 0;  ///< error of "nothing changes"
  double rmse_translation =
      0;  ///< error of the best pure translation of the start along the wind, with hindsight
  double skill_persistence = 0;  ///< 1 - rmse^2 / rmse_persistence^2
  double skill_translation = 0;
};

/// Compares two elevations of the same grid, with `initial` as the surface from which the prediction started,
/// along `direction` [rad]. Equal surfaces give exact zeros. Skill against a perfect baseline is 0 when the
/// prediction is perfect too and minus infinity otherwise. Throws Error when the layers do not fit the grid
/// or share no known cell.
Comparison compare(const GridGeometry& geometry, const HeightMap::Layer& predicted,
                   const HeightMap::Layer& measured, const HeightMap::Layer& initial, double direction);

}  // namespace aeolian
