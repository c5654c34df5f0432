#pragma once

#include <cmath>

namespace aeolian {

/// What SI is multiplied by for people to read.
/// @{
constexpr double to_mm = 1e3;
constexpr double to_degrees = 180 / M_PI;
constexpr double to_mm_per_minute = 1e3 * 60;
/// @}

}  // namespace aeolian
