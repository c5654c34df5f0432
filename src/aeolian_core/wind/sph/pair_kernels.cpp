#include "aeolian_core/wind/sph/pair_kernels.hpp"

#include <cmath>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian::sph {

AEOLIAN_KERNEL
std::size_t pick_near(const float* x, const float* y, const float* z, std::size_t n, float at_x, float at_y,
                      float at_z, float support, float* square, std::uint32_t* hit, float* hit_square) {
  const float limit = support * support;
  for (std::size_t k = 0; k < n; ++k) {
    const float dx = x[k] - at_x;
    const float dy = y[k] - at_y;
    const float dz = z[k] - at_z;
    square[k] = dx * dx + dy * dy + dz * dz;
  }
  // Without a branch: whether a place is near is anybody's guess.
  std::size_t hits = 0;
  for (std::size_t k = 0; k < n; ++k) {
    hit[hits] = static_cast<std::uint32_t>(k);
    hit_square[hits] = square[k];
    hits += square[k] < limit ? 1 : 0;
  }
  return hits;
}

AEOLIAN_KERNEL
void pulls(const float* square, std::size_t n, const Wendland& kernel, float volume, float* pull) {
  const float inverse = 1 / kernel.support;
  const float scale = volume * 20 * kernel.scale * inverse * inverse;
  for (std::size_t k = 0; k < n; ++k) {
    const float t = 1 - std::sqrt(square[k]) * inverse;
    const float s = t > 0 ? t : 0;
    pull[k] = scale * s * s * s;
  }
}

}  // namespace aeolian::sph
