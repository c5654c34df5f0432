#pragma once

#include "aeolian_core/saltation/flux_law.hpp"
#include "aeolian_core/saltation/thresholds.hpp"

namespace aeolian {

/// The flux that follows a gusty wind: dQ/dt = (Q_sat - Q) / T_sat, with hysteresis (saltation specification,
/// sec. 8).
class FluxResponse {
 public:
  /// `start`: fluid threshold [m/s], not below the law's; `time`: T_sat [s], positive. Throws Error
  /// otherwise.
  FluxResponse(const FluxLaw& law, double start, double time = 1.5);

  /// Lets this wind blow for `duration` [s], exactly; returns the flux at its end [kg m^-1 s^-1].
  double advance(double duration, double friction_velocity);
  double flux() const { return flux_; }

 private:
  FluxLaw law_;
  SaltationSwitch switch_;
  double time_;
  double flux_ = 0;
};

/// The length over which the flux adapts, about 2.2 d rho_s / rho [m], hardly dependent on the wind
/// (Andreotti, Claudin & Pouliquen 2010).
double saturation_length(const SaltatingBed& bed);

/// Flux `fetch` [m] downwind of where grains begin to be taken up: Q_sat (1 - exp(-x / L_sat)).
double flux_at_fetch(double saturated, double fetch, double saturation_length);

}  // namespace aeolian
