#pragma once

#include "aeolian_core/measure/directional_lines.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// The lag [samples] near `lag` at which later(x + lag) comes nearest to earlier(x), up to a height that all
/// share, by least squares: other than a maximum of correlations it does not depend on where the pattern is
/// cut off. Its standard error is that of the jackknife over eight strips along the lines, or, of less than
/// 16 lines, stretches of them.
Figure match_lines(const DirectionalLines& earlier, const DirectionalLines& later, double lag);

}  // namespace aeolian
