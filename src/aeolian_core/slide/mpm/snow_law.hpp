#pragma once

#include <string>

namespace aeolian {

/// What a material is made of: Hencky's elastic law, and where and how it yields.
///
/// Snow yields on the cohesive modified Cam-Clay ellipse with hardening (Gaume et al. 2018; Frischholz, ch.
/// 1.2), a cohesionless granular medium on the Drucker-Prager cone without dilation (Klar et al. 2016), with
/// the volume gained while it was loose to be lost again before it bears (Tampubolon et al. 2017). An elastic
/// body does not yield.
///
/// Invariants: p = -tr(tau) / d of the Kirchhoff stress, q = sqrt(3/2 s:s), in two dimensions of 2 x 2
/// matrices. The values of M are tied to that convention.
struct SnowLaw {
  enum class Yield { cam_clay, drucker_prager, none };

  Yield yield = Yield::cam_clay;
  double density = 210;         ///< at the beginning [kg/m^3]
  double youngs_modulus = 1e6;  ///< E [Pa]
  double poisson_ratio = 0.3;   ///< nu
  double friction = 0.5;        ///< M, slope of the critical state line q / p
  double consolidation = 7000;  ///< p0 at the beginning [Pa]
  double cohesion = 0.2;        ///< beta: isotropic tensile strength over p0
  double hardening = 0.1;       ///< xi

  double shear_modulus() const;  ///< mu [Pa]
  double lame_modulus() const;   ///< lambda [Pa]
  double bulk_modulus() const;   ///< K = E / (3 - 6 nu), of three dimensions: that of hardening [Pa]
  double bulk_modulus(int dimensions) const;  ///< K_d = lambda + 2 mu / d: that of the elastic step [Pa]
  double wave_speed() const;                  ///< of pressure waves, sqrt((lambda + 2 mu) / rho) [m/s]
  /// alpha at which p0 is what it is at the beginning: asinh(p0 / K) / xi.
  double initial_compaction() const;
  /// p0 [Pa] after a plastic compaction alpha: K sinh(xi max(alpha, 0)), at least 1e-5 K.
  double consolidation_at(double compaction) const;

  /// The slope M of a Drucker-Prager cone for an angle of internal friction [rad]: in two dimensions that of
  /// Mohr and Coulomb, sqrt(3) sin(phi), in three that of triaxial compression, 6 sin(phi) / (3 - sin(phi)).
  static double friction_of_angle(double angle, int dimensions);
};

/// Throws Error naming the property that is not physical, and what is allowed.
void check(const SnowLaw& law);

}  // namespace aeolian
