#include "aeolian_core/bedforms/theory/triangular_ripple.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

double tangent(const char* side, double angle) {
  if (!(angle > 0 && angle < M_PI / 2))
    throw Error(std::string("triangular ripple: ") + side + " at " + std::to_string(angle * 180 / M_PI) +
                " degrees, must lie between 0 and 90");
  return std::tan(angle);
}

}  // namespace

TriangularRipple::TriangularRipple(double stoss_angle, double impact_angle)
    : tan_stoss_(tangent("stoss", stoss_angle)), tan_impact_(tangent("impacts", impact_angle)) {}

double TriangularRipple::index() const { return 1 / tan_stoss_ + 1 / tan_impact_; }

double TriangularRipple::speed(EjectionLaw ejection, double height, double impact_rate, double diameter,
                               double reptation_length) const {
  const double target = impact_rate * diameter * diameter * reptation_length / height;
  if (ejection == EjectionLaw::target) return target;
  const double cos_stoss = 1 / std::hypot(1, tan_stoss_);
  return target * 2 * diameter * cos_stoss / stoss_length(height);
}

}  // namespace aeolian
