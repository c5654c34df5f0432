#pragma once

namespace aeolian {

/// The gas that the grains fly in, and what pulls them down.
struct Atmosphere {
  double density = 1.225;      ///< [kg/m^3]
  double viscosity = 1.46e-5;  ///< kinematic [m^2/s]
  double gravity = 9.81;       ///< [m/s^2]

  static Atmosphere earth() { return {}; }
  static Atmosphere mars() { return {0.02, 6.5e-4, 3.71}; }
  static Atmosphere venus() { return {65, 5e-7, 8.87}; }
};

/// Throws Error naming the property, its value and what is allowed.
void check(const Atmosphere& atmosphere);

}  // namespace aeolian
