#pragma once

#include <vector>

#include "aeolian_core/measure/ripple_relief.hpp"

namespace aeolian {

/// A crest in one row of a relief: a maximum from which the row falls by a prominence on both sides.
struct RowCrest {
  float place = 0;       ///< [samples]
  float height = 0;      ///< in the relief [m]
  float prominence = 0;  ///< the smaller of the falls to both sides, up to the next crest [m]
  /// The troughs beside it, NaN where none is seen; downwind is where samples rise.
  float upwind_trough = 0;  ///< [samples]
  float upwind_floor = 0;   ///< [m]
  float downwind_trough = 0;
  float downwind_floor = 0;
  float steepest_rise = 0;  ///< over a tenth of a wavelength, up to the crest; NaN as above
  float steepest_fall = 0;  ///< from the crest on, positive
  int stretch = 0;          ///< number of the unbroken part of the row
};

/// The crests of a row, downwind.
std::vector<RowCrest> row_crests(const RippleRelief& relief, int row, double prominence);

}  // namespace aeolian
