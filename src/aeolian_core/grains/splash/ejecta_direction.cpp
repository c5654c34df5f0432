#include "aeolian_core/grains/splash/ejecta_direction.hpp"

#include <algorithm>

#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/grains/splash/unit_vector.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {

double draw_elevation(double mean, RandomStream& random) {
  return std::clamp(mean * draw_exponential(random), 1 * degree, 179 * degree);
}

LeavingGrain ejected(const BedView& bed, double speed, double elevation) {
  const Eigen::Vector2d direction = unit_vector(elevation);
  return {bed.velocity(speed * direction.x(), speed * direction.y()), 1, 0, Origin::other};
}

void eject(const BedView& bed, int count, double mean_speed, RandomStream& random,
           std::vector<LeavingGrain>& ejecta) {
  for (int i = 0; i < count; ++i)
    ejecta.push_back(
        ejected(bed, mean_speed * draw_exponential(random), draw_elevation(mean_ejecta_elevation, random)));
}

}  // namespace aeolian
