#pragma once

#include "aeolian_core/grains/grain.hpp"

namespace aeolian {

/// Saltation in balance with one wind over a flat bed.
struct SaltationState {
  double friction_velocity = 0;  ///< [m/s]
  double impact_threshold = 0;   ///< friction velocity below which saltation dies out [m/s]
  double mass_flux = 0;          ///< height-integrated Q [kg m^-1 s^-1]
  double impact_rate = 0;        ///< impacts per area and time [m^-2 s^-1]
  double impact_speed = 0;       ///< mean [m/s]
  double impact_angle = 0;       ///< mean, below the horizontal [rad]
  double hop_length = 0;         ///< mean [m]

  /// What the three-number law does not tell: zero there.
  /// @{
  double surface_friction_velocity = 0;  ///< u*_eff, that the wind has left for the bed [m/s]
  double hop_height = 0;                 ///< mean [m]
  double flight_time = 0;                ///< mean [s]
  double impact_angle_spread = 0;        ///< standard deviation of the impact angles [rad]
  double apparent_roughness = 0;         ///< that the wind above the grains seems to have [m]
  /// @}
};

/// The steady state for quartz sand in air at sea level by the three-number law
/// Q = A (u*^2 - u*_it^2) [1 + B (u*/u*_it - 1)], zero below u*_it; impact rate Q / (m L).
///
/// A, B, u*_it, impact speed and angle and hop length are interpolated linearly in diameter between solved
/// states at 0.25 and 0.40 mm (saltation specification sec. 7). Outside, thresholds, speeds and A (which is
/// proportional to u*_it) scale with sqrt(d), hop length with d; B and the angle are held. For other
/// densities u*_it scales with sqrt(grain density / air density), Q with air density and u*_it. Speed, angle
/// and hop length rise slowly and linearly with u*. Good to 2 % at the solved diameters for u*/u*_it from 1.1
/// to 3.5, unchecked outside 0.2 to 0.6 mm. Throws Error for a friction velocity that is negative or not
/// finite, an impossible grain or air density.
SaltationState steady_saltation(double friction_velocity, const Grain& grain, double air_density = 1.225);

}  // namespace aeolian
