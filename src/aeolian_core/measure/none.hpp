#pragma once

#include <limits>

namespace aeolian {

/// What could not be measured.
constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace aeolian
