#include "aeolian_core/grains/splash/kok_renno.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/grains/splash/ejecta_direction.hpp"

namespace aeolian {

std::optional<LeavingGrain> KokRennoRebound::sample(const Impact& impact, RandomStream& random) const {
  if (random.uniform() > 0.96 * (1 - std::exp(-impact.speed))) return std::nullopt;
  const double energy = std::clamp(0.45 + 0.22 * draw_normal(random), 0.01, 0.999);
  LeavingGrain grain = ejected(BedView(impact), impact.speed * std::sqrt(energy),
                               draw_elevation(mean_rebound_elevation, random));
  grain.size_ratio = impact.size_ratio;
  grain.origin = Origin::rebound;
  return grain;
}

KokRennoEjection::KokRennoEjection(const Grain& grain) : unit_(std::sqrt(gravity * grain.diameter)) {
  check(grain);
}

double KokRennoEjection::mean_number(const Impact& impact) const {
  return 0.02 * impact.size_ratio * impact.speed / unit_;
}

double KokRennoEjection::mean_speed(double impact_speed) const {
  return 0.15 / 0.02 * (1 - std::exp(-impact_speed / (40 * unit_))) * unit_;
}

void KokRennoEjection::sample(const Impact& impact, RandomStream& random,
                              std::vector<LeavingGrain>& ejecta) const {
  const int count = draw_poisson(mean_number(impact), random);
  if (count > 0) eject(BedView(impact), count, mean_speed(impact.speed), random, ejecta);
}

}  // namespace aeolian
