#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/bedforms/frame_field.hpp"

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

 private:
  int next(int station) const;
  bool steep(const FrameField& height, int station, int patch) const;
  double relax(FrameField& height, int station, int patch);
  double relax_strip(FrameField& height, int begin, int end);
  void disturb(int station, int patch, int begin, int end);

  int stations_, rows_, patches_;
  double area_;
  double straight_;  ///< difference of height of neighbours at repose
  bool periodic_;
  std::vector<std::uint8_t> disturbed_;  ///< patches to look at, station by station
};

}  // namespace aeolian
