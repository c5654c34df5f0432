#pragma once

namespace aeolian {

/// The forces between two grains that touch, or between a grain and a wall (of infinite mass).
struct ContactLaw {
  enum class Kind {
    spring,  ///< damped normal spring, friction-limited damped shear spring (Werner 1987, eqs. 2.1-2.3)
    hertz_mindlin,  ///< elastic spheres with viscous damping of a stated restitution (Tsuji et al. 1992)
  };
  Kind kind = Kind::spring;

  double stiffness = 6e6;        ///< k_n of a spring [N/m]
  double shear_stiffness = 6e6;  ///< k_s of a spring [N/m]
  double damping = 4515;         ///< gamma_n of a spring, times the effective mass [1/s]
  double shear_damping = 4515;   ///< gamma_s of a spring, times the effective mass [1/s]

  double youngs_modulus = 5e9;  ///< of Hertz and Mindlin [Pa]
  double poisson_ratio = 0.25;  ///< of Hertz and Mindlin
  double restitution = 0.85;    ///< of Hertz and Mindlin, at any speed

  double friction = 0.5;  ///< Coulomb's, mu

  /// A spring law with equal normal and shear constants whose damping gives `restitution` to grains of this
  /// effective mass [kg] (Werner 1987, eq. 2.2 inverted: the normal force may attract near the end of a
  /// contact).
  static ContactLaw spring(double stiffness, double restitution, double effective_mass, double friction);

  /// Throws Error naming the constant, its value and what is allowed.
  void require_valid() const;
};

/// Of the spring law: exp(-gamma_n T / 4), T = 2 pi / sqrt(k_n / m - (gamma_n / 2)^2) (Werner 1987, eq. 2.2).
double restitution(double stiffness, double damping, double effective_mass);

/// How long two grains that meet at `speed` [m/s] touch [s]: T / 2 of the spring law; of Hertz' law
/// 2.87 (m^2 / (r E^2 speed))^(1/5) with effective mass [kg], radius [m] and modulus.
double contact_time(const ContactLaw& law, double effective_mass, double effective_radius, double speed);

}  // namespace aeolian
