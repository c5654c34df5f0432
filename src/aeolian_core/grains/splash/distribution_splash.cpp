#include "aeolian_core/grains/splash/distribution_splash.hpp"

#include <array>
#include <cmath>

#include "aeolian_core/grains/splash/bed_view.hpp"
#include "aeolian_core/grains/splash/composed_splash.hpp"
#include "aeolian_core/grains/splash/draws.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"distribution splash"};

}  // namespace

DistributionSplash::Parameters DistributionSplash::thesis_case(int number) {
  static constexpr std::array<Parameters, 6> cases{{{2, 0.35, 0, 0, 2.75, 0, 0.7, 0.1},
                                                    {2, 0.35, 0.2, 0.40, 2.75, 0, 0.7, 0.1},
                                                    {1, 0.35, 0.2, 0.40, 2.75, 0, 0.7, 0.1},
                                                    {0, 0, 0.2, 0.80, 0, 0, 0.7, 0.1},
                                                    {2, 0.35, 0, 0, 2.75, 1, 0.3, 0.1},
                                                    {2, 0.35, 0.2, 0.40, 2.75, 1, 0.3, 0.1}}};
  require(number >= 1 && number <= 6, "case", number, "1 to 6");
  return cases[static_cast<std::size_t>(number - 1)];
}

DistributionSplash::DistributionSplash(const Parameters& parameters, Balance balance)
    : parameters_(parameters), balance_(balance) {
  const Parameters& p = parameters_;
  const struct {
    const char* name;
    double value;
  } all[] = {{"c1", p.c1},
             {"c2", p.c2},
             {"c3", p.c3},
             {"c4", p.c4},
             {"c5", p.c5},
             {"c6", p.c6},
             {"restitution", p.restitution},
             {"conversion", p.conversion}};
  for (const auto& one : all)
    require(one.value >= 0 && std::isfinite(one.value), one.name, one.value, "finite and not negative");
}

double DistributionSplash::mean_rebounds(const Impact& impact) const {
  const double along = impact.speed * std::cos(BedView(impact).angle());
  return parameters_.c1 * along / (along + parameters_.c5);
}

double DistributionSplash::mean_ejecta(const Impact& impact) const {
  return parameters_.c3 * parameters_.c4 * impact.speed * impact.speed;
}

void DistributionSplash::draw_once(const Impact& impact, RandomStream& random, SplashEvent& event) const {
  const Parameters& p = parameters_;
  const BedView bed(impact);
  const double along = impact.speed * std::cos(bed.angle());
  const double down = impact.speed * std::sin(bed.angle());
  const double leaves_along = p.c6 * p.restitution * (1 - p.conversion) * along;
  event.rebound.reset();
  event.ejecta.clear();
  const int rebounds = p.c1 > 0 ? draw_rounded(p.c1 * along / (along + p.c5), random) : 0;
  for (int i = 0; i < rebounds; ++i) {
    const double away = p.conversion * along + p.restitution * down + p.c2 * draw_normal(random);
    if (away <= 0) continue;
    if (!event.rebound)
      event.rebound = LeavingGrain{bed.velocity(leaves_along, away), impact.size_ratio, 0, Origin::rebound};
    else
      event.ejecta.push_back({bed.velocity(leaves_along, away), 1, 0, Origin::other});
  }
  for (int left = p.c3 > 0 ? draw_poisson(mean_ejecta(impact), random) : 0; left > 0; --left)
    event.ejecta.push_back(
        {bed.velocity(leaves_along, p.c4 * draw_exponential(random)), 1, 0, Origin::other});
}

void DistributionSplash::draw(const Impact& impact, RandomStream& random, SplashEvent& event) const {
  draw_once(impact, random, event);
  if (balance_ == Balance::mean) return;
  constexpr int tries = 4;
  for (int i = 1; i < tries && !within_impact(event, impact); ++i) draw_once(impact, random, event);
  if (within_impact(event, impact)) return;
  if (event.rebound && !within_impact({event.rebound, {}}, impact)) event.rebound.reset();
  drop_beyond_impact(event, impact);
}

}  // namespace aeolian
