#pragma once

#include <utility>
#include <vector>

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"
#include "aeolian_core/bedforms/height_map/sweep_bundle.hpp"

namespace aeolian {

/// Where the impact rain sets grains reptating and where they come down within one step of time, on a bed
/// given in a wind frame.
///
/// Erosion follows exposure; hops are exponentially distributed on a flat bed and end early where the bed has
/// risen since take-off, late where it has fallen, by `shortening` times the rise: 1 / tangent of the angle
/// at which grains come down. To first order in the rise, so that it is a flux, -shortening (h F - G), where
/// F is the flux of grains through a height h and G the same flux with each grain times its height of
/// take-off. Everything is relative to a flat bed: erosion and deposition are 1 there.
///
/// Lines are swept side by side, and each is stepped in time by itself by the third-order method of Shu and
/// Osher (1988): each stage follows the one before two stations behind, so that a bed is read once per step.
class ImpactSweep {
 public:
  /// `hop` is the mean reptation length [m].
  ImpactSweep(const WindFrame& frame, const ImpactAngles& angles, double hop, double shortening);

  using Supply = SweepTask::Supply;
  /// 1 everywhere unless told. Called by several threads.
  void set_supply(Supply supply) { supply_ = std::move(supply); }

  /// Sweeps a bed over a step in which a flat bed loses `depth` [m]. Heights [m] with pads filled; impacts
  /// see the height above `dune`.
  void run(const FrameField& bed, const FrameField& dune, double depth);

  /// The same on hard ground, where no more is eroded than lies on it at the beginning of the step. Lines do
  /// no work where `sandy` says that nothing can move and less than `least_flux` arrives, which comes down
  /// there. `active`, which is of the last run or full, becomes the patches that deposition may reach;
  /// elsewhere nothing changes.
  void run(const FrameField& bed, const FrameField& dune, const HardGround& ground,
           const ActivePatches& sandy, double depth, ActivePatches& active);

  /// Means over the step for line q at a station: between rows q - 1 and q, q = 0 ... rows. Deposition may
  /// fall below zero where the bed is so steep that hops change much over a cell.
  const FrameField& erosion() const { return erosion_; }
  const FrameField& deposition() const { return deposition_; }
  /// Flux that lines bring in and take out at open borders, in flat-bed cells.
  double inflow() const { return inflow_; }
  double outflow() const { return outflow_; }

 private:
  int longest_shadow(const FrameField& bed, const FrameField& dune) const;
  std::vector<SweptBundle> run_bundles(const SweepTask& task);
  SweepTask task(const FrameField& bed, const FrameField& dune, const HardGround* ground,
                 const ActivePatches* sandy, double depth);
  void close_period();

  const WindFrame& frame_;
  HopLaw law_;
  FrameField erosion_, deposition_;
  std::vector<double> seam_in_, seam_out_;
  Supply supply_;
  double inflow_ = 0;
  double outflow_ = 0;
};

}  // namespace aeolian
