#include "aeolian_core/grains/splash/ejecta_direction.hpp"

#include <algorithm>

#include "aeolian_core/grains/dynamics/unit_vector.hpp"
#include "aeolian_core/grains/splash/draws.hpp"

namespace aeolian {

double draw_elevation(double mean, RandomStream& random) {
  constexpr double degree = M_PI / 180;
  return std::clamp(mean * draw_exponential(random), 1 * degree, 179 * degree);
}

LeavingGrain ejected(const BedView& bed, double speed, double elevation) {
  const Eigen::Vector2d direction = unit_vector(elevation);
  return {bed.velocity(speed * direction.x(), speed * direction.y()), 1, 0, Origin::other};
}

}  // namespace aeolian
