#pragma once

#include <vector>

namespace aeolian {

/// Transport in three numbers, Q = A (u*^2 - u*_it^2) [1 + B (u* / u*_it - 1)], zero up to u*_it: what solved
/// states are summed up in (saltation specification, sec. 5.6).
struct FluxLaw {
  double threshold = 0;   ///< u*_it [m/s]
  double amplitude = 0;   ///< A [kg s m^-3]
  double correction = 0;  ///< B

  /// Q [kg m^-1 s^-1].
  double flux(double friction_velocity) const {
    if (!(friction_velocity > threshold)) return 0;
    return amplitude * (friction_velocity * friction_velocity - threshold * threshold) *
           (1 + correction * (friction_velocity / threshold - 1));
  }

  /// Through fluxes at friction velocities above a threshold, with least squares of relative errors. Throws
  /// Error for fewer than two, or one that is not above the threshold.
  static FluxLaw fit(double threshold, const std::vector<double>& friction_velocity,
                     const std::vector<double>& flux);
};

/// Slope of ln Q against ln(u*^2 - u*_it^2): one where the flux grows as the stress in excess of the
/// threshold's.
double excess_stress_exponent(double threshold, const std::vector<double>& friction_velocity,
                              const std::vector<double>& flux);

}  // namespace aeolian
