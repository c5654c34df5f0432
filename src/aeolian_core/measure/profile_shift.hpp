#pragma once

#include <optional>

#include "aeolian_core/measure/profile_analysis.hpp"

namespace aeolian {

/// How far a pattern has moved from one profile of a section to another.
struct ProfileShift {
  Figure shift;            ///< towards larger x [m]
  double correlation = 0;  ///< of the two once shifted
};

/// The shift of the highest correlation within `range` of `expected` [m], to a fraction of a sample. What
/// both have at a shift loses its own line there: lines taken off before would differ with the phase of the
/// pattern and pull the maximum. The standard error is that of least-squares matching with a gain and a line,
/// its noise taken from the differences that remain, summed over stretches of half the range within which
/// they may be correlated. Nothing when no maximum inside exceeds a correlation of 0.3. Throws Error when the
/// sections do not overlap.
std::optional<ProfileShift> profile_shift(const EvenProfile& earlier, const EvenProfile& later,
                                          double expected, double range);

}  // namespace aeolian
