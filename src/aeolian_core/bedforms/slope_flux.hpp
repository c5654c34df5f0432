#pragma once

#include "aeolian_core/bedforms/hard_ground.hpp"

namespace aeolian {

/// Moves sand down the slopes by the flux q = -D grad h with D = `scale` * activity (per cell), conserving
/// volume to rounding. Periodic borders are joined, others are walls.
class SlopeFlux {
 public:
  SlopeFlux(const WindFrame& frame, double cell, double scale);

  /// Acts for `duration` [s] in as many explicit stages as the strongest activity asks for, second order in
  /// time. `activity` and `height` have their pads filled, and so has the new height.
  void run(const FrameField& activity, double strongest_activity, double duration, FrameField& height);

  /// The same on hard ground, among active patches: no more flows out of a cell than lies in it, nothing
  /// through what is not open.
  void run(const FrameField& activity, double strongest_activity, double duration, const HardGround& ground,
           const ActivePatches& active, FrameField& height);

 private:
  class Stages;
  template <class Work>
  void for_stations(Work&& work) const;

  const WindFrame& frame_;
  double cell_;
  double scale_;
  FrameField next_;
};

}  // namespace aeolian
