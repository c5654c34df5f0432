#include "aeolian_core/grains/splash/anderson_haff.hpp"

#include <cmath>

#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/grains/splash/ejecta_direction.hpp"

namespace aeolian {

std::optional<LeavingGrain> AndersonHaffRebound::sample(const Impact& impact, RandomStream& random) const {
  if (random.uniform() > 0.95 * (1 - std::exp(-2 * impact.speed))) return std::nullopt;
  double ratio = 0.56 + 0.2 * draw_normal(random);
  while (ratio <= 0 || ratio >= 1) ratio = 0.56 + 0.2 * draw_normal(random);
  LeavingGrain grain =
      ejected(BedView(impact), ratio * impact.speed, draw_elevation(mean_rebound_elevation, random));
  grain.size_ratio = impact.size_ratio;
  grain.origin = Origin::rebound;
  return grain;
}

void AndersonHaffEjection::sample(const Impact& impact, RandomStream& random,
                                  std::vector<LeavingGrain>& ejecta) const {
  const int count = draw_poisson(mean_number(impact), random);
  eject(BedView(impact), count, 0.25 * std::pow(impact.speed, 0.3), random, ejecta);
}

}  // namespace aeolian
