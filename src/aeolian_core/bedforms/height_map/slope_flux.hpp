#pragma once

#include <optional>

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"

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
  template <class Work>
  void for_blocks(int each, Work&& work) const;
  template <class Work>
  void for_active(const ActivePatches& active, Work&& work) const;
  int stages(double strongest_activity, double duration) const;
  double gain(double duration) const;
  void find_deep(const HardGround& ground, const ActivePatches& active, const FrameField& height);
  void run_deep(const FrameField& activity, double strongest_activity, double duration,
                const HardGround& ground, const ActivePatches& active, FrameField& height);
  void run_thin(const FrameField& activity, double duration, const HardGround& ground,
                const ActivePatches& active, FrameField& height);

  const WindFrame& frame_;
  double cell_;
  double scale_;
  FrameField next_;
  FrameField deep_;  ///< 1 where much sand lies on hard ground, else 0
  std::optional<ActivePatches> was_active_;
};

}  // namespace aeolian
