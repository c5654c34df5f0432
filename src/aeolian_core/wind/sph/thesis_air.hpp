#pragma once

#include "aeolian_core/wind/sph/air_ground.hpp"
#include "aeolian_core/wind/sph/cell_order.hpp"

namespace aeolian::sph {

/// The thesis' algorithm (Dobusch 2016, ch. 3 and 4) as it is described, for its tables and its defects.
/// What it does not state is chosen here. Lengths in metres.
struct ThesisSettings {
  int side = 16;             ///< particles along a side, s
  double box = 1000;         ///< length of the side [m]
  int reach = 2;             ///< kernel's support over the particle's diameter, r_d
  double wind = 10;          ///< [m/s]
  double direction = 0;      ///< that it blows to, counter-clockwise from x [rad]
  bool near_kernels = true;  ///< a second copy of density and pressure, with the radius for a support
  bool sphere_mass = true;   ///< false: calibrated on the start lattice, which the thesis does not
  bool gravity = true;
  double sound = 100;       ///< root of its k, not stated [m/s]
  double density = 1.2;     ///< rho_0, not stated [kg/m^3]
  double viscosity = 1;     ///< mu over rho_0, not stated [m^2/s]
  double friction = 0.999;  ///< of the velocity that a step keeps, not stated
  double limit = 2;         ///< of the speed over the wind's, not stated
  double step = 1.0 / 32;   ///< [s]
};

/// Number-density SPH with poly6 and spiky kernels and Tait's pressure (4.3 to 4.11), ghosts that follow the
/// terrain, a ring of particles blown at the height over the ground at which they came (and so up and down
/// every hill to the very top), wind as a lower bound of the speed, friction, a limiter, gravity after it,
/// and collisions along the face.
class ThesisAir {
 public:
  /// `ground` in units of the particles' diameter, side + 2 reach long. Throws Error for what is not allowed.
  ThesisAir(const AirGround& ground, const ThesisSettings& settings);

  void step();
  /// Simulated particles; the ring and the ghosts come after them.
  std::size_t simulated() const { return simulated_; }
  std::size_t size() const { return place_.size(); }
  const std::vector<Four>& place() const { return place_; }    ///< in diameters
  const std::vector<Four>& motion() const { return motion_; }  ///< [m/s]
  /// Height of a particle over the ground [diameters].
  float height(std::size_t i) const { return relative_[i]; }
  double diameter() const { return diameter_; }  ///< [m]
  /// Mean density of the simulated particles over rho_0; (4.4), with the near kernels not counted.
  double mean_density() const;
  /// The mean height of the simulated particles over the ground [m], twice of which is the height of the air.
  double mean_height() const;
  double limited_share() const { return limited_share_; }  ///< of the particles, in the last step

  /// (4.17), (4.18), with the signs of (4.19) put right, and (4.20): what the thesis divides its lift by at a
  /// height over the ground [m] and a wind [m/s].
  static double lift_divisor(double height, double wind, bool rising);

 private:
  void find();
  void forces();
  void evolve();

  AirGround ground_;
  ThesisSettings settings_;
  Four wind_;  ///< of the surroundings [m/s]
  double diameter_;
  double mass_;
  double limited_share_ = 0;
  std::size_t simulated_ = 0, ghosts_from_ = 0;
  float level_;  ///< where columns start [diameters]
  CellOrder cells_;
  std::vector<Four> place_, motion_, force_, sorted_;
  std::vector<float> relative_;                                       ///< height over the ground [diameters]
  std::vector<float> count_, near_count_, pressure_, near_pressure_;  ///< delta of (4.5), p of (4.3)
};

}  // namespace aeolian::sph
