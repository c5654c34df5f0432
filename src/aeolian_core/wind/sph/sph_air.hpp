#pragma once

#include "aeolian_core/wind/sph/air_ground.hpp"
#include "aeolian_core/wind/sph/neighbours.hpp"
#include "aeolian_core/wind/sph/pressure_solver.hpp"

namespace aeolian::sph {

/// The wind of the surroundings, in units of its scale U and of particle spacings.
struct Upwind {
  float east = 1, north = 0;  ///< unit vector along it
  /// Friction velocity over U; zero for a wind that is the same at all heights.
  float friction = 0;
  float roughness = 0;  ///< z0 over the spacing
  /// Its speed at a height over the ground.
  float speed(float height) const;
};

struct AirSettings {
  float support = 2.4F;      ///< of the kernel, in spacings
  float step = 0.2F;         ///< of time, of the support over the greatest speed
  float residual = 1e-3F;    ///< divergence that the pressure leaves, root mean square, in U over spacing
  int iterations = 60;       ///< of the pressure, at most
  float viscosity = 0.002F;  ///< kinematic, in U times spacing
  float damping = 0.2F;      ///< the same for what differs from a linear field between two particles
  float shifting = 0.5F;     ///< strength of the shift towards even spacing (Lind et al. 2012)
  float ring_rate = 1.0F;    ///< at which the ring gives its wind, in U over spacing
};

/// What a guard did since the start; in a sound run all are zero but `refilled`, which counts what a moving
/// box makes necessary.
struct AirGuards {
  std::size_t lifted = 0;    ///< particles found in the ground and put back on it
  std::size_t lowered = 0;   ///< found above the lid
  std::size_t slowed = 0;    ///< faster than twenty times the wind
  std::size_t unsolved = 0;  ///< steps whose pressure did not converge
  std::size_t refilled =
      0;  ///< particles put on free sites of the lattice as the ground under the box changed
};

/// A box of air made of particles, over a ground and under a lid, through which the wind of the surroundings
/// blows (Dobusch 2016), after the corrected forms of the wind spec.
///
/// Incompressible: each step a pressure is solved for that makes the velocities free of divergence (Cummins &
/// Rudman 1999), with gradients that are exact for linear fields, walls by mirror images and particles kept
/// evenly spread by shifting (Lind, Xu, Stansby & Rogers 2012). No gravity: the pressure is the perturbation
/// of the neutral air. No speed is clamped.
///
/// The box repeats along x and y. In a ring along its borders the air is given the upwind profile; what
/// leaves on one side comes in again on the other, so that the mass is the same at all times and nothing
/// overlaps. All is counted in particle spacings and the speed U of the surroundings, so that a result holds
/// at every scale and speed.
class SphAir {
 public:
  SphAir(const AirGround& ground, const Upwind& upwind, const AirSettings& settings);

  void step();
  /// Another wind, from now on.
  void set_upwind(const Upwind& upwind) { upwind_ = upwind; }
  /// Moves the box by whole or partial spacings over the ground, however far; the air stays where it is over
  /// the ground or, where the box leaves it behind, comes in anew on the other side.
  void move(double dx, double dy);

  std::size_t size() const { return place_.size(); }
  double time() const { return time_; }
  float last_step() const { return dt_; }
  int iterations() const { return solver_.iterations(); }
  const AirGuards& guards() const { return guards_; }
  const AirGround& ground() const { return ground_; }
  const AirSettings& settings() const { return settings_; }
  const Torus& torus() const { return torus_; }

  /// Particles in the order of cells(): places with the distance from the nearest wall, velocities with the
  /// pressure (over density, in U^2).
  const std::vector<Four>& place() const { return place_; }
  const std::vector<Four>& motion() const { return motion_; }
  std::vector<Four>& motion() { return motion_; }
  /// Derivatives of the velocity along x, y and z at the last step.
  const std::vector<Four>& slope(int axis) const { return slope_[axis]; }
  const CellOrder& cells() const { return cells_; }
  const NeighbourFinder& neighbours() const { return finder_; }

  /// Density over that at rest, of each particle where it is now.
  std::vector<float> density();
  /// Divergence of the velocity as it is now, in U over spacing.
  std::vector<float> divergence();
  /// Sum of the squares of speeds, over that of the undisturbed wind.
  double energy() const;
  /// Share of the ring's wind at a place, 0 within to 1 at the border.
  float ring(float x, float y) const;

 private:
  static constexpr float far_shift = 0.1F;  ///< that a particle may be shifted in a step [spacings]
  /// Where between the old velocity (0) and the new (1) the air is free of divergence: at the middle no
  /// energy is lost.
  static constexpr float implicitness = 0.5F;

  void settle();
  void start();
  void order();
  void refill();
  void see_walls();
  void differentiate();
  void damp();
  void press();
  void push();
  void carry(std::size_t i, const Four& way);
  Four given_wind(float height) const;

  AirGround ground_;
  Upwind upwind_;
  AirSettings settings_;
  Torus torus_;
  CellOrder cells_;
  NeighbourFinder finder_;
  PressureSolver solver_;
  AirGuards guards_;
  double time_ = 0;
  float dt_ = 0;
  float fastest_ = 1;
  std::vector<Four> place_, motion_, normal_, sorted_;
  std::vector<Four> slope_[3];
  std::vector<Four> bend_;   ///< Laplacian of the velocity
  std::vector<Four> force_;  ///< gradient of the pressure
  std::vector<float> pressure_, source_, wall_drop_, greatest_;
};

}  // namespace aeolian::sph
