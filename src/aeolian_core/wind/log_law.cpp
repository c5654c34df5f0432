#include "aeolian_core/wind/log_law.hpp"

#include <cmath>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// ln(z/z0), the mean speed at a height in units of u*/kappa.
double log_profile(double height, double roughness) {
  if (!(roughness > 0) || !std::isfinite(roughness))
    throw Error("log law: the roughness length is " + std::to_string(roughness) + " m, must be positive");
  if (!(height > roughness) || !std::isfinite(height))
    throw Error("log law: the height is " + std::to_string(height) +
                " m, must be above the roughness length, " + std::to_string(roughness) + " m");
  return std::log(height / roughness);
}

void require_speed(const char* what, double speed) {
  if (!(speed >= 0) || !std::isfinite(speed))
    throw Error(std::string("log law: the ") + what + " is " + std::to_string(speed) +
                " m/s, must be zero or positive");
}

}  // namespace

double friction_velocity(double speed, double height, double roughness) {
  require_speed("speed", speed);
  return von_karman * speed / log_profile(height, roughness);
}

double log_law_speed(double friction_velocity, double height, double roughness) {
  require_speed("friction velocity", friction_velocity);
  return friction_velocity / von_karman * log_profile(height, roughness);
}

}  // namespace aeolian
