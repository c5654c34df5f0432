#include "aeolian_core/saltation/thresholds.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

double cohesive_fluid_threshold(const SaltatingBed& bed, double cohesion) {
  check(bed);
  if (!(cohesion >= 0 && std::isfinite(cohesion)))
    throw Error("fluid threshold: the cohesion is " + std::to_string(cohesion) +
                " N/m, must be zero or more");
  const double d = bed.grain.diameter;
  const double weight = bed.atmosphere.gravity * d + 6 * cohesion / (M_PI * bed.grain.density * d);
  return std::sqrt(0.0123 * bed.grain.density / bed.atmosphere.density * weight);
}

double slope_factor(double slope, double repose) {
  if (!(repose > 0 && repose < M_PI / 2))
    throw Error("slope: the angle of repose is " + std::to_string(repose) +
                " rad, must be between 0 and pi / 2");
  if (!(std::abs(slope) < M_PI / 2))
    throw Error("slope: " + std::to_string(slope) + " rad, must be between -pi / 2 and pi / 2");
  return std::sqrt(std::max(0.0, std::sin(repose + slope)) / std::sin(repose));
}

Grain snow_grain(double diameter) {
  Grain grain;
  grain.diameter = diameter;
  grain.density = 910;
  check(grain);
  return grain;
}

SaltationSwitch::SaltationSwitch(double start, double stop) : start_(start), stop_(stop) {
  if (!(stop >= 0 && start >= stop && std::isfinite(start)))
    throw Error("saltation: it starts at " + std::to_string(start) + " m/s and stops at " +
                std::to_string(stop) + " m/s, must not stop above where it starts");
}

bool SaltationSwitch::update(double friction_velocity) {
  on_ = friction_velocity > (on_ ? stop_ : start_);
  return on_;
}

}  // namespace aeolian
