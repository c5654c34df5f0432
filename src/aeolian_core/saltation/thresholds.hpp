#pragma once

#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// Fluid threshold of grains that stick together, sqrt(0.0123 s (g d + 6 b / (pi rho_s d))), s = rho_s / rho
/// (Shao & Lu 2000; saltation specification, sec. 7). `cohesion`: b [N/m], 1.5e-4 for dry sand, several times
/// that for damp sand and snow. [m/s]; throws Error for a cohesion that is negative or not finite.
double cohesive_fluid_threshold(const SaltatingBed& bed, double cohesion = 1.5e-4);

/// By what a threshold grows on a bed that rises by `slope` [rad] in the direction of the wind:
/// sqrt(sin(repose + slope) / sin(repose)) (Iversen & Rasmussen 1994); zero where the bed falls more steeply
/// than the angle of repose.
double slope_factor(double slope, double angle_of_repose);

/// Dry old snow of this diameter [m] (saltation specification, sec. 7): density of ice.
Grain snow_grain(double diameter = 0.0003);

/// Saltation starts above one friction velocity and goes on until the wind falls below another.
class SaltationSwitch {
 public:
  /// `stop` <= `start` [m/s]; throws Error otherwise.
  SaltationSwitch(double start, double stop);
  /// Whether grains saltate in this wind, after all winds before.
  bool update(double friction_velocity);
  bool on() const { return on_; }

 private:
  double start_, stop_;
  bool on_ = false;
};

}  // namespace aeolian
