#include <cmath>
#include <memory>

#include "splash_rows.hpp"
#include "splash_sample.hpp"

#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/grains/splash/splash_table.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

constexpr int draws = 40000;

/// What a place between nodes is made of: rebounds' speed and upward speed over the impact's, ejecta and
/// their upward momentum over sqrt(g d), of one event.
struct Means {
  Sample ratio, upward, number, momentum;
};

Means measure(const Splash& splash, const Impact& impact, double unit, std::uint64_t stream) {
  Means means;
  RandomStream random(1, stream);
  SplashEvent event;
  for (int i = 0; i < draws; ++i) {
    splash.sample(impact, random, event);
    means.ratio.add(event.rebound ? event.rebound->velocity.norm() / impact.speed : 0);
    means.upward.add(event.rebound ? event.rebound->velocity.z() / impact.speed : 0);
    means.number.add(static_cast<double>(event.ejecta.size()));
    double momentum = 0;
    for (const LeavingGrain& grain : event.ejecta) momentum += grain.velocity.z() / unit;
    means.momentum.add(momentum);
  }
  return means;
}

}  // namespace

void table_rows(AccuracyTable& table) {
  table.section("A table of 2 000 events at each of 4 x 5 nodes",
                "Made of `coarse_sand` on coarse sand, at 70, 95, 120 and 145 sqrt(g d) and 10, 12, 15, 18 "
                "and 22 degrees. "
                "Targets: linear interpolation of the function's own means at the nodes about, so the "
                "table's 2 000 events "
                "are to blame for up to some 3 %.");
  const SplashMaterial material = splash_material("coarse_sand");
  const double unit = std::sqrt(gravity * material.grain.diameter);
  const auto splash = splash_of("coarse_sand", material);
  std::vector<SplashCase> cases;
  RandomStream random(7, 1);
  for (const double speed : {70.0, 95.0, 120.0, 145.0})
    for (const double angle : {10.0, 12.0, 15.0, 18.0, 22.0}) {
      SplashCase one{{speed * unit, angle * degree}, {}};
      for (int i = 0; i < 2000; ++i) one.events.push_back(splash->sample(one.impact, random));
      cases.push_back(std::move(one));
    }
  const TabulatedSplash tabulated(
      std::make_shared<SplashTable>(SplashTable::build(cases, material.grain.diameter,
                                                       {"./twin bench splash_accuracy", "coarse sand", 1})),
      material.grain);
  struct Place {
    double low_speed, high_speed, low_angle, high_angle, share_speed, share_angle;
  };
  for (const Place& p : {Place{70, 95, 12, 15, 0.5, 0.5},
                         {95, 120, 18, 22, 0.6, 0.5},
                         {120, 145, 10, 12, 0.4, 0.5},
                         {95, 120, 15, 18, 0, 0}}) {
    const double speed = p.low_speed + p.share_speed * (p.high_speed - p.low_speed);
    const double angle = p.low_angle + p.share_angle * (p.high_angle - p.low_angle);
    double ratio = 0, upward = 0, number = 0, momentum = 0;
    for (const bool fast : {false, true})
      for (const bool steep : {false, true}) {
        const double weight =
            (fast ? p.share_speed : 1 - p.share_speed) * (steep ? p.share_angle : 1 - p.share_angle);
        const Impact node{(fast ? p.high_speed : p.low_speed) * unit,
                          (steep ? p.high_angle : p.low_angle) * degree};
        const Means made = measure(*splash, node, unit, 1);
        ratio += weight * made.ratio.mean();
        upward += weight * made.upward.mean();
        number += weight * made.number.mean();
        momentum += weight * made.momentum.mean();
      }
    const Means ours = measure(tabulated, {speed * unit, angle * degree}, unit, 2);
    const std::string at = fmt::format(" at {:g} sqrt(g d), {:g} degrees", speed, angle);
    table.relative_row("rebound speed over impact's" + at, ratio, ours.ratio.mean(), 0.03,
                       ours.ratio.error());
    table.relative_row("its upward speed" + at, upward, ours.upward.mean(), 0.03, ours.upward.error());
    table.relative_row("ejecta" + at, number, ours.number.mean(), 0.03, ours.number.error());
    table.relative_row("upward momentum of ejecta" + at, momentum, ours.momentum.mean(), 0.05,
                       ours.momentum.error());
  }
}

}  // namespace aeolian
