#pragma once

#include <cmath>

namespace aeolian {

constexpr double degree = M_PI / 180;  ///< [rad]

}  // namespace aeolian
