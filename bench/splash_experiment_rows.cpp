#include <cmath>
#include <functional>

#include "splash_rows.hpp"
#include "splash_sample.hpp"

#include "aeolian_core/grains/splash/coarse_sand.hpp"
#include "aeolian_core/grains/splash/reptation.hpp"
#include "aeolian_core/grains/splash/splash_choice.hpp"
#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

constexpr int draws = 10000;

struct Found {
  Sample along, upward, number, up, direction, energy, reptation;
  double most_energy = 0, most_momentum = 0;
};

Found measure(const CoarseSandRow& row) {
  const auto splash = splash_of("coarse_sand", "coarse_sand");
  const Impact impact{row.speed / 100, row.angle * degree};
  Found found;
  RandomStream random(1, 1);
  SplashEvent event;
  for (int i = 0; i < draws; ++i) {
    splash->sample(impact, random, event);
    if (event.rebound) {
      found.along.add(event.rebound->velocity.x() / impact.speed / std::cos(impact.angle));
      found.upward.add(event.rebound->velocity.z() / impact.speed / std::sin(impact.angle));
    }
    found.number.add(static_cast<double>(event.ejecta.size()));
    const double energy = kinetic_energy(event) / kinetic_energy(impact);
    found.energy.add(energy);
    found.most_energy = std::max(found.most_energy, energy);
    found.most_momentum = std::max(found.most_momentum, momentum_along(impact, event) / momentum(impact));
    for (const LeavingGrain& grain : event.ejecta) {
      found.up.add(100 * grain.velocity.z());
      found.direction.add(std::atan2(grain.velocity.x(), grain.velocity.z()) / degree);
      found.reptation.add(100 * hop_length(grain.velocity.x(), grain.velocity.z(), 0));
    }
  }
  return found;
}

void spread_rows(AccuracyTable& table, const std::string& what, const CoarseSandRow::Spread& wanted,
                 const Sample& found) {
  table.relative_row(what, wanted.mean, found.mean(), 0.05, found.error());
  table.relative_row(what + ", half-width", wanted.half_width, found.deviation(), 0.15,
                     found.deviation_error());
}

void experiment(AccuracyTable& table) {
  double sum = 0;
  std::vector<std::pair<const CoarseSandRow*, Sample>> reptation;
  for (const CoarseSandRow& row : coarse_sand_rows()) {
    table.section(
        fmt::format("Coarse sand, {:g} cm/s at {:g} degrees", row.speed, row.angle),
        fmt::format("X1 and X2, tables 3.11 and 3.12: {} events and {} ejecta in the experiment, {} "
                    "draws here (`coarse_sand`).",
                    row.events, row.ejecta, draws));
    const Found found = measure(row);
    spread_rows(table, "eps_ix", row.along, found.along);
    spread_rows(table, "eps_iy", row.upward, found.upward);
    spread_rows(table, "ejecta of an event", row.number, found.number);
    spread_rows(table, "vertical speed of ejecta, cm/s", row.ejecta_up, found.up);
    spread_rows(table, "angle of ejecta from the vertical, degrees", row.direction, found.direction);
    table.row("energy out over in", row.energy_ratio, found.energy.mean(), 0.03, found.energy.error());
    table.remark("reptation of a grain, cm", row.reptation, found.reptation.mean(), found.reptation.error());
    table.statement("no event with more energy or momentum than its impact",
                    fmt::format("at most {:.3f} and {:.3f}", found.most_energy, found.most_momentum),
                    found.most_energy <= 1 + 1e-9 && found.most_momentum <= 1 + 1e-9);
    if (row.angle < 15 || row.angle > 16) continue;
    reptation.emplace_back(&row, found.reptation);
    sum += found.reptation.mean();
  }
  table.section("Reptation of a grain does not depend on the speed of the impact",
                "X3, at 15 to 16 degrees: each against their mean.");
  for (const auto& [row, found] : reptation)
    table.relative_row(fmt::format("reptation of a grain at {:g} cm/s, cm", row->speed),
                       sum / static_cast<double>(reptation.size()), found.mean(), 0.15, found.error());
}

/// Means of cases A and B of the thesis (tables 3.4 and 3.2), straight lines in the angle between.
struct Ejecta {
  double reptation, number, square;
};
Ejecta thesis_ejecta(double angle) {
  const double share = (angle - 15) / 10;
  const Ejecta a{1.20, 6, 1.60 * 1.60 + 0.30 * 0.30}, b{0.55, 7, 1.65 * 1.65 + 0.85 * 0.85};
  return {a.reptation + share * (b.reptation - a.reptation), a.number + share * (b.number - a.number),
          a.square + share * (b.square - a.square)};
}

double on_slope(double slope) {
  const Ejecta e = thesis_ejecta(15 + slope);
  return mean_reptation(e.reptation, e.number, e.square, slope * degree);
}

void slopes(AccuracyTable& table) {
  table.section("Reptation on slopes",
                "Sec. 3.7: ejecta of cases A and B of the thesis, 15 degrees to the level.");
  table.row("R on the level, cm", 120, 100 * on_slope(0), 0.5);
  table.row("R at 10 degrees by the formula, cm", -32, 100 * on_slope(10), 0.5);
  table.row("R at 10 degrees, thesis, cm", -35, 100 * on_slope(10), 5);
  double low = 0, high = 10;
  for (int i = 0; i < 40; ++i) (on_slope((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  table.row("R is zero at, degrees", 8, low, 0.6);
}

}  // namespace

void experiment_rows(AccuracyTable& table) {
  experiment(table);
  slopes(table);
}

}  // namespace aeolian
