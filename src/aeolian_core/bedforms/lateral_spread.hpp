#pragma once

#include <vector>

#include "aeolian_core/bedforms/wind_frame.hpp"

namespace aeolian {

/// Spreads what comes down across the wind, whatever its angle to the grid: a nearly Gaussian kernel over
/// rows whose taps lie on the perpendicular to the wind, between stations by second-order interpolation. The
/// sum is conserved to rounding, what is positive stays so, and open borders are walls.
class LateralSpread {
 public:
  /// `sigma`: the standard deviation across the wind, in cells.
  LateralSpread(const WindFrame& frame, double sigma);

  /// Stations upwind and downwind of a result that have part in it.
  int reach() const { return passes_; }

  /// Values of the stations [begin, end), which are field stations 0 ... with pads filled, are replaced by
  /// their spread. Where the stretch does not end at a wall, `reach()` stations there are left in between.
  /// Only rows [row_begin, row_end) are worked on. Nothing is spread to or from where `open`, the field of
  /// the whole frame or null, is zero.
  void run(FrameField& values, int begin, int end, int row_begin, int row_end, const FrameField* open) const;

  /// Rows that a value may reach.
  int reach_across() const { return passes_ * static_cast<int>(weight_.size()); }

 private:
  void pass(const FrameField& from, int begin, int count, int row_begin, int row_end, const FrameField* open,
            FrameField& to) const;

  const WindFrame& frame_;
  int passes_ = 0;
  std::vector<double> weight_;  ///< of the taps 0, 1, ... rows away, in one pass
};

}  // namespace aeolian
