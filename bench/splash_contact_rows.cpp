// With which mass a bed answers: it depends on who touches whom (splash specification, check S3 and trap T4).

#include <cmath>

#include "splash_rows.hpp"

#include "aeolian_core/grains/impacts/impact_statistics.hpp"
#include "aeolian_core/grains/impacts/impact_study.hpp"

namespace aeolian {
namespace {

using Packing = BedRecipe::Packing;

constexpr int impacts = 120;

GrainWorld<2> thesis_world(double friction) {
  GrainWorld<2> world;
  world.law.friction = friction;
  return world;
}

/// Only first contacts matter: each shot is followed for a tenth of the thesis' time.
std::vector<double> masses(const std::vector<Bed<2>>& beds, double speed = 30, double angle = M_PI / 12) {
  ImpactSeries series;
  series.impacts = impacts;
  series.speed = speed;
  series.angle = angle;
  ImpactRules rules;
  rules.follow = 0.2;
  std::vector<double> result;
  for (const ImpactOutcome& outcome : fire_series<2>(beds, series, rules))
    if (outcome.contact && std::isfinite(outcome.contact->effective_mass))
      result.push_back(outcome.contact->effective_mass);
  return result;
}

std::vector<Bed<2>> loose_beds(const GrainWorld<2>& world) {
  std::vector<Bed<2>> beds;
  for (std::uint64_t seed = 11; seed < 17; ++seed) beds.push_back(make_bed(BedRecipe{}, world, seed));
  return beds;
}

/// The rows of a dense bed, more apart than a target moves while it is hit.
Bed<2> blown_apart(const Bed<2>& dense) {
  GrainDynamics<2> grains(dense.grains.world());
  for (const int grain : dense.grains.numbers())
    grains.add(1.06 * dense.grains.position(grain), dense.grains.radius(grain));
  BedRecipe recipe;
  recipe.length = 1.06 * dense.length;
  return settled_bed(std::move(grains), recipe);
}

/// The upper of the two middle ones, and 1.25 standard errors of a mean.
void median_row(AccuracyTable& table, const char* what, double low, double high, std::vector<double> values) {
  const MeanValue mean = mean_value(values);
  std::sort(values.begin(), values.end());
  table.range_row(what, low, high, values.empty() ? std::nan("") : values[values.size() / 2],
                  1.25 * mean.error);
}

}  // namespace

void contact_state_rows(AccuracyTable& table) {
  table.section("Simulated impacts: the target's effective mass over a grain's",
                fmt::format("Check S3: medians over events with one contact, of {} impacts at 30 m/s and 15 "
                            "degrees, as the specification's pilot has them, and means over speed and angle, "
                            "of loose beds (cases A, B, E and F) and of the close-packed one.",
                            impacts));
  BedRecipe close;
  close.packing = Packing::dense;
  close.grains = 363;
  const Bed<2> dense = make_bed(close, thesis_world(0.5), 1);
  const std::vector<Bed<2>> loose = loose_beds(thesis_world(0.5));
  median_row(table, "close-packed bed, settled", 2.0, 2.3, masses({dense}));
  median_row(table, "loose bed", 1.3, 1.6, masses(loose));
  median_row(table, "loose bed without friction", 1.1, 1.3, masses(loose_beds(thesis_world(0))));
  median_row(table, "bed blown apart, so that no neighbours touch", 0.9, 1.1, masses({blown_apart(dense)}));
  const auto independence = [&](const char* name, const std::vector<Bed<2>>& beds) {
    const MeanValue reference = mean_value(masses(beds));
    const auto as_reference = [&](const char* what, double speed, double angle_deg) {
      const MeanValue mean = mean_value(masses(beds, speed, angle_deg * M_PI / 180));
      table.relative_row(fmt::format("{}, mean at {}", name, what), reference.mean, mean.mean, 0.15,
                         std::hypot(mean.error, reference.error));
    };
    as_reference("25 degrees as at 15", 30, 25);
    as_reference("10 m/s as at 30 m/s", 10, 15);
    as_reference("40 m/s as at 30 m/s", 40, 15);
  };
  independence("loose bed", loose);
  independence("close-packed bed", {dense});
}

}  // namespace aeolian
