#pragma once

#include <cstdint>

#include "aeolian_core/bedforms/height_map/impact_sweep.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// What hops grain by grain differ from their mean: each cell exchanges a random amount of sand with one
/// random cell where a grain from it may come down. Over many steps the variances and covariances are those
/// of single grains that are struck at random: per step (e + dep) d_eff^3 / A in a cell of area A that loses
/// and gains the depths e and dep, less what hops end where they began. Exchanges conserve volume; at open
/// borders they go on at the opposite border.
///
/// Random numbers are a function of seed, step and cell.
class ImpactNoise {
 public:
  struct Hop {
    double length;      ///< mean [m]
    double spread;      ///< standard deviation across the wind [m]
    double shortening;  ///< as in RippleParameters
  };

  /// In each step the share `share` of the stations, in turn, draws the noise of 1 / share steps (rounded):
  /// the same variance for less work.
  ImpactNoise(const WindFrame& frame, double cell, const Hop& hop, double grain_volume, double share,
              std::uint64_t seed);

  /// Noise of a step, counted from the first of a run, in which a flat bed loses `depth` [m]. Pads are
  /// filled, before and after. On hard ground (null: none) cells exchange only what both of them have, among
  /// active patches.
  void run(const ImpactSweep& sweep, double depth, std::uint64_t step, const HardGround* ground,
           const ActivePatches& active, FrameField& bed) const;

 private:
  struct Cell {
    int station, row;
  };
  Cell target(Cell from, const Philox::Block& random, const FrameField& bed) const;

  const WindFrame& frame_;
  double cell_;
  Hop hop_;
  double grain_volume_;
  std::uint64_t turns_;
  Philox random_;
};

}  // namespace aeolian
