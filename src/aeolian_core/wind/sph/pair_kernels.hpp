#pragma once

#include <cstdint>

#include "aeolian_core/wind/sph/wendland.hpp"

namespace aeolian::sph {

/// Which of n places are closer than the support to a point: their indices and squared distances, at most n
/// of each. Gives how many.
std::size_t pick_near(const float* x, const float* y, const float* z, std::size_t n, float at_x, float at_y,
                      float at_z, float support, float* square, std::uint32_t* hit, float* hit_square);

/// volume times -W'/r of each squared distance.
void pulls(const float* square, std::size_t n, const Wendland& kernel, float volume, float* pull);

}  // namespace aeolian::sph
