#include "aeolian_core/wind/direction.hpp"

namespace aeolian {

double direction_from_meteorological(double from_degrees) {
  // From north is to the south; clockwise becomes counter-clockwise. Reduced in degrees, where quarters are
  // exact.
  return wrap_angle(degrees_to_radians(std::remainder(270 - from_degrees, 360.0)));
}

double meteorological_from_direction(double direction) {
  const double degrees = std::fmod(270 - radians_to_degrees(direction), 360.0);
  const double positive = degrees < 0 ? degrees + 360 : degrees;
  return positive < 360 ? positive : 0;  // a tiny negative number plus 360 rounds to 360
}

double wrap_angle(double angle) {
  const double wrapped = std::remainder(angle, 2 * M_PI);
  return wrapped <= -M_PI ? M_PI : wrapped;
}

}  // namespace aeolian
