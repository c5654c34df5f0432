#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "aeolian_core/slide/mpm/node_block.hpp"
#include "aeolian_core/slide/mpm/snow_law.hpp"

namespace aeolian {

/// A particle as it is put in and read out.
template <int Dim>
struct MaterialPoint {
  using Matrix = Eigen::Matrix<double, Dim, Dim>;

  Point<Dim> place = Point<Dim>::Zero();     ///< [m], the last axis upwards
  Point<Dim> velocity = Point<Dim>::Zero();  ///< [m/s]
  Matrix affine = Matrix::Zero();            ///< velocity gradient [1/s]
  Matrix b = Matrix::Identity();             ///< elastic left Cauchy-Green tensor F F^T
  double alpha = 0;   ///< compaction, see flow_and_stress; SnowLaw::initial_compaction() for fresh snow
  double mass = 0;    ///< [kg], in two dimensions per metre of width
  double volume = 0;  ///< of the undeformed snow [m^d]
};

struct MpmSettings {
  double cell = 0.01;  ///< of the background grid [m]
  Transfer transfer = Transfer::apic;
  double flip_share = 0.99;  ///< of the velocity's increment; with Transfer::flip only
  double courant = 0.4;      ///< cells per step, of waves and of particles
  double time_step = 0;      ///< longest step [s]; 0: what the elastic wave allows
  double gravity = 9.81;     ///< [m/s^2]
  /// Blocks whose particles have been slower than this for so long are skipped until something moves at their
  /// nodes; 0: none is. The patience must tell a slab that begins to slide from one that is stuck.
  double rest_speed = 2e-3;     ///< [m/s]
  double rest_patience = 0.05;  ///< [s]
  int threads = 0;              ///< 0: as many as the machine has. The result does not depend on it.
};

/// What a run has cost so far.
struct MpmWork {
  long steps = 0;
  long particle_steps = 0;  ///< of particles that were awake
  long shortened = 0;       ///< steps shorter than waves allow, because particles were fast
};

/// The material point method for one material among obstacles (Frischholz, ch. 1.2 and 3.1), in two
/// dimensions (plane strain) or three.
///
/// Quadratic B-splines on a grid of which only the blocks about particles exist. Particles are kept by block
/// in packs of four. Each block of particles sums into nodes of its own, and each block of nodes adds up what
/// the blocks about it hold, in a fixed order: no races, and the same bits for any number of threads.
template <int Dim>
class MaterialPoints {
 public:
  /// Throws Error for settings that are not possible, among them a time_step that elastic waves of this law
  /// do not allow.
  MaterialPoints(const MpmSettings& settings, const SnowLaw& law, std::vector<Obstacle<Dim>> obstacles = {});
  ~MaterialPoints();
  MaterialPoints(MaterialPoints&&) noexcept;

  /// Throws Error for particles that are not finite, have no mass or volume, or lie too far from the origin.
  void add(const std::vector<MaterialPoint<Dim>>& points);

  /// Goes on by `duration` [s], in steps that waves and the fastest particle allow. Throws Error that tells
  /// where and when a step has strained a particle by more than its own size.
  void advance(double duration);

  std::vector<MaterialPoint<Dim>> points() const;  ///< in the order in which they were added
  std::size_t size() const;
  std::size_t awake() const;    ///< particles that are not asleep
  double time() const;          ///< [s]
  double longest_step() const;  ///< that waves allow [s]
  double fastest() const;       ///< speed of the fastest particle [m/s]
  const MpmWork& work() const;
  const SnowLaw& law() const;
  const MpmSettings& settings() const;

 private:
  class Engine;
  std::unique_ptr<Engine> engine_;
};

extern template class MaterialPoints<2>;
extern template class MaterialPoints<3>;

}  // namespace aeolian
