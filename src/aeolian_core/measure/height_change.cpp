#include "aeolian_core/measure/height_change.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

HeightChange HeightChange::of_ripples(double celerity, double wavelength, double height) {
  for (const double value : {celerity, wavelength, height})
    if (!(value > 0 && std::isfinite(value)))
      throw Error("height change: celerity, wavelength and height of the ripples are " +
                  std::to_string(celerity) + ", " + std::to_string(wavelength) + " and " +
                  std::to_string(height) + ", must be positive");
  const double frequency = 2 * M_PI * celerity / wavelength;
  return {frequency * height / std::sqrt(8.0), 2.1 / frequency};
}

// The moments of an integrated Ornstein-Uhlenbeck process over x = seconds / rate_time; where they would
// cancel, their series.
HeightStep height_step(const HeightChange& change, double seconds) {
  const double tau = change.rate_time;
  const double x = seconds / tau;
  const double s2 = change.rate_sigma * change.rate_sigma;
  const double lost = -std::expm1(-x);
  HeightStep step;
  step.rate_kept = 1 - lost;
  step.height_per_rate = tau * lost;
  step.rate_variance = -s2 * std::expm1(-2 * x);
  step.covariance = s2 * tau * lost * lost;
  const double moments =
      x < 1e-2 ? x * x * x * (2.0 / 3 - x * (0.5 - x * 7 / 30)) : 2 * x - 2 * lost - lost * lost;
  step.height_variance = s2 * tau * tau * moments;
  return step;
}

}  // namespace aeolian
