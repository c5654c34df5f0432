#pragma once

#include <cmath>

namespace aeolian {

constexpr double degrees_to_radians(double degrees) { return degrees * (M_PI / 180); }
constexpr double radians_to_degrees(double radians) { return radians * (180 / M_PI); }

/// Our direction of wind (where it blows to, counter-clockwise from east, (-pi, pi]) from the meteorological
/// one (where it comes from, clockwise from north, degrees): a north wind, 0 degrees, blows to the south,
/// -pi/2.
double direction_from_meteorological(double from_degrees);
/// The inverse, in [0, 360).
double meteorological_from_direction(double direction);
/// The same angle in (-pi, pi].
double wrap_angle(double angle);

}  // namespace aeolian
