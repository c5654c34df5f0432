#pragma once

namespace aeolian {

constexpr double radius = 0.01;  ///< of the grains of these tests [m]

}  // namespace aeolian
