#pragma once

namespace aeolian {

constexpr double gravity = 9.81;  ///< [m/s^2]

/// A granular material of one size.
struct Grain {
  double diameter = 0.00025;        ///< [m]
  double density = 2650;            ///< of the solid [kg/m^3]
  double porosity = 0.40;           ///< of the bed at rest
  double angle_of_repose = 0.5760;  ///< [rad], 33 degrees

  double mass() const;  ///< of one grain, a sphere [kg]
  /// Side of the cube that a grain takes in the bed, d (pi / (6 (1 - porosity)))^(1/3) [m]
  /// (Werner 1987, ch. V: effective grain diameter).
  double effective_diameter() const;
};

/// Throws Error naming the property, its value and what is allowed.
void check(const Grain& grain);

}  // namespace aeolian
