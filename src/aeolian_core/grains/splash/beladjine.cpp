#include "aeolian_core/grains/splash/beladjine.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/grains/splash/ejecta_direction.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {

double beladjine_restitution(double angle) { return 0.87 - 0.72 * std::sin(angle); }

double beladjine_vertical_restitution(double angle) { return 0.30 / std::sin(angle) - 0.15; }

std::optional<LeavingGrain> BeladjineRebound::sample(const Impact& impact, RandomStream&) const {
  const BedView bed(impact);
  const double total = beladjine_restitution(bed.angle());
  const double away = beladjine_vertical_restitution(bed.angle()) * std::sin(bed.angle());
  const double along = std::sqrt(std::max(0.0, total * total - away * away));
  return LeavingGrain{bed.velocity(impact.speed * along, impact.speed * away), impact.size_ratio, 0,
                      Origin::rebound};
}

BeladjineEjection::BeladjineEjection(const Grain& grain, double amplitude)
    : unit_(std::sqrt(gravity * grain.diameter)), amplitude_(amplitude) {
  check(grain);
  if (!(amplitude >= 0) || !std::isfinite(amplitude))
    throw Error("Beladjine's ejection: amplitude is " + std::to_string(amplitude) +
                ", must be finite and not negative");
}

double BeladjineEjection::mean_number(const Impact& impact) const {
  const double restitution = beladjine_restitution(BedView(impact).angle());
  return amplitude_ * (1 - restitution * restitution) * std::max(0.0, impact.speed / (40 * unit_) - 1);
}

double BeladjineEjection::mean_speed(double impact_speed) const {
  return 1.2 * std::sqrt(std::sqrt(impact_speed / unit_)) * unit_;
}

void BeladjineEjection::sample(const Impact& impact, RandomStream& random,
                               std::vector<LeavingGrain>& ejecta) const {
  const int count = draw_poisson(mean_number(impact), random);
  if (count > 0) eject(BedView(impact), count, mean_speed(impact.speed), random, ejecta);
}

}  // namespace aeolian
