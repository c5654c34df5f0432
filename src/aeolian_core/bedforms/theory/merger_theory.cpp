#include "aeolian_core/bedforms/theory/merger_theory.hpp"

#include <cmath>

#include "aeolian_core/bedforms/theory/ripple_collision.hpp"

namespace aeolian {

double overshoot_height(double reptation_length, double impact_angle) {
  return reptation_length * std::tan(impact_angle);
}

double mean_least_effective_height(double ratio) {
  return (collide(ratio, EjectionLaw::target).least_effective_height() +
          collide(ratio, EjectionLaw::brink).least_effective_height()) /
         2;
}

double LimitingWavelength::merged() const { return std::hypot(smaller, larger); }

LimitingWavelength limiting_wavelength(const TriangularRipple& shape, double ratio, double effective_height) {
  const double smaller = shape.wavelength(effective_height / mean_least_effective_height(ratio));
  return {smaller, smaller / ratio};
}

FluctuationBudget fluctuation_budget(const RippleStrip& ripple, double impact_rate, double total_reptation) {
  const double volume = ripple.wavelength * ripple.wavelength / ripple.index / 2 * ripple.width;
  const double grains = volume / std::pow(ripple.grain_diameter, 3);
  const double impacts_per_time = impact_rate * ripple.wavelength / 2 * ripple.width;
  const double speed = impacts_per_time * total_reptation / grains;
  const double period = ripple.wavelength / speed;
  const double impacts = impacts_per_time * period;
  return {speed, period, impacts, 1 / std::sqrt(impacts)};
}

}  // namespace aeolian
