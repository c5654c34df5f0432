#include "aeolian_core/grains/ejecta_direction.hpp"

#include <algorithm>

namespace aeolian {

double draw_elevation(double mean, RandomStream& random) {
  constexpr double degree = M_PI / 180;
  return std::clamp(mean * random.exponential(), 1 * degree, 179 * degree);
}

LeavingGrain ejected(const BedView& bed, double speed, double elevation) {
  return {bed.velocity(speed * std::cos(elevation), speed * std::sin(elevation)), 1, 0, Origin::other};
}

}  // namespace aeolian
