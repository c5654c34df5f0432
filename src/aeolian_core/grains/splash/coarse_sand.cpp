#include "aeolian_core/grains/splash/coarse_sand.hpp"

#include <cmath>

#include "aeolian_core/grains/splash/bed_view.hpp"
#include "aeolian_core/grains/splash/unit_vector.hpp"

namespace aeolian {
namespace {

double unit_of(const Grain& grain) {
  check(grain);
  return std::sqrt(gravity * grain.diameter);
}

}  // namespace

CoarseSandRebound::CoarseSandRebound(const Grain& grain) : unit_(unit_of(grain)) {}

std::optional<LeavingGrain> CoarseSandRebound::sample(const Impact& impact, RandomStream& random) const {
  const CoarseSandSettings& settings = CoarseSandSettings::instance();
  const BedView bed(impact);
  const CoarseSandSettings::Place place = settings.choose(impact.speed / unit_, bed.angle(), random);
  const CoarseSandSettings::Node& node = settings.node(place.node);
  const Eigen::Vector2d path = unit_vector(bed.angle());
  constexpr int tries = 16;
  for (int i = 0; i < tries; ++i) {
    const double along = node.along.draw(random) * path.x();
    const double away = place.slope_factor * node.upward.draw(random) * path.y();
    if (along * along + away * away > 1) continue;
    if (away <= 0) break;
    return LeavingGrain{bed.velocity(impact.speed * along, impact.speed * away), impact.size_ratio, 0,
                        Origin::rebound};
  }
  return std::nullopt;
}

CoarseSandEjection::CoarseSandEjection(const Grain& grain) : unit_(unit_of(grain)) {}

double CoarseSandEjection::mean_number(const Impact& impact) const {
  return CoarseSandSettings::instance().mean_number(impact.speed / unit_, BedView(impact).angle());
}

void CoarseSandEjection::sample(const Impact& impact, RandomStream& random,
                                std::vector<LeavingGrain>& ejecta) const {
  const CoarseSandSettings& settings = CoarseSandSettings::instance();
  const double speed = impact.speed / unit_;
  const double factor = settings.beyond(speed);
  if (factor == 0) return;
  const BedView bed(impact);
  const CoarseSandSettings::Node& node = settings.node(settings.choose(speed, bed.angle(), random).node);
  int count = node.number.draw(random);
  if (factor != 1) count = draw_rounded(factor * count, random);
  for (int i = 0; i < count; ++i) {
    const auto [away, direction] = node.draw_ejectum(random);
    const Eigen::Vector2d along_away = unit_vector(M_PI / 2 - direction);
    ejecta.push_back(
        {bed.velocity(unit_ * away * along_away.x() / along_away.y(), unit_ * away), 1, 0, Origin::other});
  }
}

}  // namespace aeolian
