#include <cmath>

#include "aeolian_core/grains/splash/bed_view.hpp"
#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

std::array<double, 4> place_of(const Impact& impact, const BedView& bed, double unit) {
  return {impact.speed / unit, bed.angle(), impact.size_ratio, impact.roughness};
}

}  // namespace

TabulatedSplash::TabulatedSplash(std::shared_ptr<const SplashTable> table, const Grain& grain)
    : table_(std::move(table)), diameter_(grain.diameter), unit_(std::sqrt(gravity * grain.diameter)) {
  if (!table_) throw Error("splash: table is missing, must be given");
  check(grain);
}

double TabulatedSplash::mean_ejecta(const Impact& impact) const {
  return table_->mean_number(place_of(impact, BedView(impact), unit_));
}

void TabulatedSplash::draw(const Impact& impact, RandomStream& random, SplashEvent& event) const {
  const BedView bed(impact);
  const std::array<double, 4> place = place_of(impact, bed, unit_);
  const double factor = table_->beyond(place[SplashTable::speed]);
  const auto add = [&](const SplashTable::Event& from, double share) {
    for (const SplashTable::Ejectum* grain = from.first; grain != from.last; ++grain) {
      if (share < 1 && random.uniform() >= share) continue;
      event.ejecta.push_back({bed.velocity(unit_ * grain->along, unit_ * grain->away, unit_ * grain->across),
                              grain->size_ratio, bed.along(diameter_ * grain->distance), grain->origin});
    }
  };
  constexpr int tries = 4;
  for (int i = 0; i < tries; ++i) {
    const SplashTable::Event one = table_->draw(place, random);
    event.rebound.reset();
    if (!one.captured)
      event.rebound = LeavingGrain{
          bed.velocity(impact.speed * one.along, impact.speed * one.away, impact.speed * one.across),
          impact.size_ratio, 0, Origin::rebound};
    event.ejecta.clear();
    add(one, factor);
    for (int more = factor > 1 ? draw_rounded(factor - 1, random) : 0; more > 0; --more)
      add(table_->draw(place, random), 1);
    if (within_impact(event, impact)) return;
  }
  drop_beyond_impact(event, impact);
}

}  // namespace aeolian
