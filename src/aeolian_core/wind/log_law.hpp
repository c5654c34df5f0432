#pragma once

namespace aeolian {

constexpr double von_karman = 0.4;

/// Aerodynamic roughness length of a flat bed of grains at rest, z0 = d/30 [m] (Werner 1987, sec. 4.2;
/// Nikuradse).
constexpr double grain_roughness(double grain_diameter) { return grain_diameter / 30; }

/// Friction velocity u* [m/s] from the mean speed [m/s] at a height [m] over ground of roughness z0 [m]:
/// u* = kappa u / ln(z/z0) (Werner 1987, eq. 4.28). Throws Error for a negative speed or a height not above
/// z0.
double friction_velocity(double speed, double height, double roughness);

/// Its inverse: the mean speed at a height.
double log_law_speed(double friction_velocity, double height, double roughness);

}  // namespace aeolian
