#include <cmath>
#include <memory>

#include "splash_rows.hpp"
#include "splash_sample.hpp"

#include "aeolian_core/grains/splash_choice.hpp"
#include "aeolian_core/grains/splash_table.hpp"

namespace aeolian {
namespace {

constexpr double degree = M_PI / 180;
constexpr int draws = 40000;

struct Means {
  Sample ratio, upward, number, up;
};

Means measure(const Splash& splash, const Impact& impact, std::uint64_t stream) {
  Means means;
  RandomStream random(1, stream);
  SplashEvent event;
  for (int i = 0; i < draws; ++i) {
    splash.sample(impact, random, event);
    means.ratio.add(event.rebound ? event.rebound->velocity.norm() / impact.speed : 0);
    means.upward.add(event.rebound ? event.rebound->velocity.z() / impact.speed / std::sin(impact.angle) : 0);
    means.number.add(static_cast<double>(event.ejecta.size()));
    for (const LeavingGrain& grain : event.ejecta) means.up.add(grain.velocity.z());
  }
  return means;
}

}  // namespace

void table_rows(AccuracyTable& table) {
  table.section(
      "A table of 2 000 events at each of 4 x 5 nodes against the function that it was made of",
      "`coarse_sand` on coarse sand, at 70, 95, 120 and 145 sqrt(g d) and 10, 12, 15, 18 and 22 degrees, "
      "drawn "
      "between the nodes. eps_iy is curved in the angle, so straight lines between nodes lie above it.");
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
  for (const auto& [speed, angle] : {std::pair{82.0, 13.5}, {110.0, 20.0}, {130.0, 11.0}, {95.0, 15.0}}) {
    const Impact impact{speed * unit, angle * degree};
    const Means made = measure(*splash, impact, 1), ours = measure(tabulated, impact, 2);
    const std::string at = fmt::format(" at {:g} sqrt(g d), {:g} degrees", speed, angle);
    table.relative_row("rebound speed ratio" + at, made.ratio.mean(), ours.ratio.mean(), 0.03,
                       ours.ratio.error());
    table.relative_row("eps_iy" + at, made.upward.mean(), ours.upward.mean(), 0.05, ours.upward.error());
    table.relative_row("ejecta" + at, made.number.mean(), ours.number.mean(), 0.05, ours.number.error());
    table.relative_row("upward speed of ejecta, m/s" + at, made.up.mean(), ours.up.mean(), 0.05,
                       ours.up.error());
  }
}

}  // namespace aeolian
