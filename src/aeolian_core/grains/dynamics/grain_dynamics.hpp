#pragma once

#include <cstddef>
#include <limits>
#include <memory>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/grains/dynamics/contact_law.hpp"
#include "aeolian_core/grains/grain.hpp"

namespace aeolian {

/// Vectors of a world of two dimensions (discs; y is up) or three (spheres; z is up).
template <int Dim>
using Vector = Eigen::Matrix<double, Dim, 1>;
/// Rate of turning: counter-clockwise in two dimensions, a vector in three [rad/s].
template <int Dim>
using Spin = Eigen::Matrix<double, Dim == 2 ? 1 : 3, 1>;

/// A wall. In two dimensions a segment of a line that is met from both sides and whose ends count as points;
/// in three a plane without bounds that keeps the grains on the side its normal points to.
template <int Dim>
struct Wall;

template <>
struct Wall<2> {
  Vector<2> from, to;                      ///< [m]
  Vector<2> velocity = Vector<2>::Zero();  ///< prescribed [m/s]
};

template <>
struct Wall<3> {
  Vector<3> point;   ///< anywhere on it [m]
  Vector<3> normal;  ///< of unit length
  Vector<3> velocity = Vector<3>::Zero();
};

/// When a grain counts as resting and is left out of the work until something wakes it: being moved, losing a
/// neighbour, or an impulse of its awake neighbours, beyond what it bore when it fell asleep, that would set
/// it in motion at `speed`. What a sleeper fails to answer is at most its mass times that speed; results
/// converge to those without sleep as it falls. A grain in the air or beside a moving wall does not sleep.
struct SleepRule {
  /// Below this speed, and this speed over a radius of turning, for `patience` [m/s]; zero: none ever sleeps.
  double speed = 0;
  double patience = 0;  ///< [s]
};

/// What surrounds the grains and what they are made of.
template <int Dim>
struct GrainWorld {
  ContactLaw law;
  double density = 2000;                                          ///< [kg/m^3]
  double thickness = 0.01;                                        ///< of discs [m]; spheres have none
  Vector<Dim> acceleration = -9.81 * Vector<Dim>::Unit(Dim - 1);  ///< of gravity [m/s^2]
  std::vector<Wall<Dim>> walls;                                   ///< not repeated across a period
  /// After what length a side begins anew [m], zero: it does not. Positions lie from zero to the length,
  /// which is at least eight times the largest radius.
  Vector<Dim> period = Vector<Dim>::Zero();
  double steps_per_contact = 36;  ///< of the shortest contact; 8 or more
  double drag = 0;                ///< slows all motion, for settling beds [1/s]
  SleepRule sleep;
};

/// A pair that touches; `second` is -1 - w for the w-th wall.
template <int Dim>
struct GrainContact {
  int first, second;
  Vector<Dim> normal;                ///< of unit length, from second to first
  double overlap;                    ///< [m]
  double normal_force, shear_force;  ///< on first; the normal one pushes, the shear one's size [N]
};

/// Soft grains that touch, roll, slip and fly: the molecular dynamics of Werner (1987), ch. II, for discs and
/// spheres of any sizes.
///
/// Symplectic (leapfrog) in positions and velocities. The step follows from the shortest contact and is
/// shortened so that no grain moves more than a tenth of the smallest radius in it. A grain keeps its number
/// for ever. The result does not depend on the number of threads. A copy goes on independently, bit by bit
/// as the original would.
///
///     GrainWorld<2> world;
///     world.walls = {{{0, 0}, {1, 0}}};
///     GrainDynamics<2> grains(world);
///     const int grain = grains.add({0.5, 0.03}, 0.01);
///     grains.advance(0.5);
///     double height = grains.position(grain).y();
template <int Dim>
class GrainDynamics {
 public:
  /// Throws Error naming what is not valid in the world, its value and what is allowed.
  explicit GrainDynamics(const GrainWorld<Dim>& world);
  ~GrainDynamics();
  GrainDynamics(const GrainDynamics&);
  GrainDynamics& operator=(const GrainDynamics&);
  GrainDynamics(GrainDynamics&&) noexcept;
  GrainDynamics& operator=(GrainDynamics&&) noexcept;

  const GrainWorld<Dim>& world() const;  ///< with the walls where they have moved
  /// Other rules from now on, for the same grains: another drag, sleep or law. Throws as the constructor
  /// does.
  void set_world(const GrainWorld<Dim>& world);
  /// Spreads the work of a step over so many threads; zero: as many as the machine has. One to begin with.
  void set_threads(int threads);

  /// Adds a grain and returns its number, one more than the last. Throws Error for a radius that is not
  /// positive, values that are not finite and places outside a period.
  int add(const Vector<Dim>& position, double radius, const Vector<Dim>& velocity = Vector<Dim>::Zero(),
          const Spin<Dim>& spin = Spin<Dim>::Zero());
  void remove(int grain);

  std::size_t size() const;                 ///< grains that are there
  const std::vector<int>& numbers() const;  ///< of those that are there, ascending
  bool holds(int grain) const;
  Vector<Dim> position(int grain) const;  ///< [m]
  Vector<Dim> velocity(int grain) const;  ///< at the same instant as the position [m/s]
  Spin<Dim> spin(int grain) const;        ///< [rad/s]
  double radius(int grain) const;         ///< [m]
  double mass(int grain) const;           ///< [kg]
  void set_motion(int grain, const Vector<Dim>& velocity, const Spin<Dim>& spin);  ///< wakes it, too

  double time() const;  ///< [s]
  /// One step, at most so long [s]; returns how long it was. Throws Error, and leaves all as it was, when two
  /// grains overlap so much that no step can part them (by more than the smaller radius).
  double step(double most = std::numeric_limits<double>::infinity());
  /// Steps until `duration` [s] later.
  void advance(double duration);

  /// All pairs that touch, by ascending numbers.
  std::vector<GrainContact<Dim>> contacts() const;
  /// Those of one grain.
  std::vector<GrainContact<Dim>> contacts(int grain) const;
  double kinetic_energy() const;    ///< with that of turning [J]
  double potential_energy() const;  ///< of gravity, relative to the origin, and of springs [J]
  std::size_t awake() const;        ///< grains that are not asleep
  std::vector<int> moving() const;  ///< their numbers, in any order
  /// Grains moved by steps so far: what the work is proportional to.
  std::size_t grain_steps() const;

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

extern template class GrainDynamics<2>;
extern template class GrainDynamics<3>;

}  // namespace aeolian
