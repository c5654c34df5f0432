#include "aeolian_core/bedforms/height_map/repose.hpp"

#include <cstdint>

namespace aeolian {
namespace {

AEOLIAN_INLINE double size(double x) { return x < 0 ? -x : x; }

AEOLIAN_WIDE_KERNEL bool is_any_steep(std::ptrdiff_t count, std::ptrdiff_t ahead, double straight,
                                      const double* __restrict h, const double* __restrict behind) {
  const double along = straight * (1 + repose_slack);
  const double oblique = along * 1.4142135623730951;
  std::int64_t any = 0;
  // Most slopes are so gentle that no diagonal, the sum of two of them, can be too steep.
  const double gentle = 0.7 * along;
  for (std::ptrdiff_t i = 0; i < ahead; ++i)
    any |= (size(behind[i] - h[i]) > gentle) | (size(h[i + 1] - h[i]) > gentle);
  any |= size(behind[ahead] - h[ahead]) > gentle;
  if (any == 0) return false;
  any = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) any |= size(behind[i] - h[i]) > along;
  for (std::ptrdiff_t i = 0; i < ahead; ++i)
    any |= (size(h[i + 1] - h[i]) > along) | (size(behind[i + 1] - h[i]) > oblique) |
           (size(behind[i] - h[i + 1]) > oblique);
  return any != 0;
}

}  // namespace

bool any_steep(std::ptrdiff_t count, std::ptrdiff_t ahead, double straight, const double* height,
               const double* behind) {
  return is_any_steep(count, ahead, straight, height, behind);
}

}  // namespace aeolian
