#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"

namespace aeolian {

/// Lets what is steeper than repose slide down, conserving volume to rounding, by projection: no explicit
/// diffusion. Slopes are taken to the eight neighbours. What is less than a hundredth beyond repose is left
/// alone; what slides comes to rest within a hundredth of repose. Periodic borders are joined, others are
/// walls.
///
/// Patches of a station and the next, 32 rows wide, are relaxed as vectors, in strips of stations at the same
/// time; only those that are too steep and those beside them cost.
class Avalanches {
 public:
  Avalanches(int stations, int rows, double cell, double tan_repose, bool periodic);

  /// Height with pads filled, before and after. Returns the volume moved [m^3].
  double run(FrameField& height);

  /// The same on hard ground, begun in active patches: no more slides than lies on the floor, nothing where
  /// it is not open. `active` grows by what the slides reach.
  double run(FrameField& height, const HardGround& ground, ActivePatches& active);

 private:
  int next(int station) const;
  bool steep(const FrameField& height, int station, int patch) const;
  double relax(FrameField& height, int station, int patch);
  bool is_deep(const FrameField& height, const HardGround& ground, int station, int patch) const;
  double relax_on_ground(FrameField& height, const HardGround& ground, int station, int patch);
  template <class Relax>
  double relax_strip(const FrameField& height, int begin, int end, Relax&& relax);
  template <class Relax>
  double relax_all(FrameField& height, const ActivePatches* active, Relax&& relax);
  void disturb(int station, int patch, int begin, int end);

  int stations_, rows_, patches_;
  double area_;
  double straight_;  ///< difference of height of neighbours at repose
  bool periodic_;
  std::vector<std::uint8_t> disturbed_;  ///< patches to look at, station by station
};

}  // namespace aeolian
