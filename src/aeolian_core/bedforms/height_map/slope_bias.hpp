#pragma once

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"

namespace aeolian {

/// Makes the downslope bias of reptation grow with the square of the slope: activity *= 1 + min(8, (slope /
/// doubling slope)^2), slopes being those above the dune-scale surface. On stoss slopes of about 8 degrees
/// all ejecta run downhill (specification of the splash, sec. 3.7), which the bias of gentle slopes misses.
class SlopeBias {
 public:
  /// `cell` [m]; the dune surface has its pads filled.
  SlopeBias(const WindFrame& frame, double cell, double tan_doubling_slope, const FrameField& dune);

  /// Acts on one station, and fills the pads of its activity. Those of the bed are filled, here and at the
  /// stations beside. Returns the strongest activity among the station's active patches.
  double stiffen(int station, const FrameField& bed, const ActivePatches& active, FrameField& activity) const;

 private:
  const WindFrame& frame_;
  double per_height_;  ///< square of the slope, in doubling slopes, by that of a difference over two cells
  const FrameField& dune_;
};

/// The same on all stations. `activity`, `bed` and `dune` have their pads filled.
double stiffen(const WindFrame& frame, double cell, double tan_doubling_slope, const FrameField& dune,
               const FrameField& bed, const ActivePatches& active, FrameField& activity);

}  // namespace aeolian
