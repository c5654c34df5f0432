#include <array>
#include <cmath>

#include "ripple_rows.hpp"

#include "aeolian_core/bedforms/bedforms.hpp"
#include "aeolian_core/bedforms/theory/independent_members.hpp"
#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr int beds = 4;
constexpr double interval = 20;  ///< between maps of a series [s]

struct Pattern {
  double wavelength = 0, height = 0, speed = 0;
};

/// The mean over some beds, and its standard error.
struct Mean {
  double value = 0, error = 0;
};

Mean mean_of(const std::vector<std::array<Pattern, 2>>& all, std::size_t which, double Pattern::*figure) {
  Mean mean;
  const auto count = static_cast<double>(all.size());
  for (const auto& one : all) mean.value += one[which].*figure / count;
  for (const auto& one : all) mean.error += std::pow(one[which].*figure - mean.value, 2);
  mean.error = std::sqrt(mean.error / (count * (count - 1)));
  return mean;
}

Forcing wind(double direction) {
  Grain grain;
  grain.diameter = 4e-4;
  return make_forcing(steady_saltation(0.45, grain), direction, grain, MeanSplash{});
}

/// Moves a bed on, and tells of the last two minutes: the last map's ripples, and the mean speed of all.
Pattern grow(BedModel& model, HeightMap map, const Forcing& forcing, double minutes) {
  RippleTracker tracker(forcing.direction, forcing.grain.diameter);
  model.advance(map, forcing, 60 * (minutes - 2));
  for (double time = 0; time <= 120; time += interval) {
    if (time > 0) model.advance(map, forcing, interval);
    tracker.add(map.geometry(), map.layer(layer::elevation), time);
  }
  const RippleHistory history = tracker.history();
  const RippleField& field = history.maps.back().field;
  return {field.wavelength.value, field.height.value, history.celerity.value};
}

/// Ripples of the lattice bed and of the height-map model after so many minutes from one bed: flat, or as the
/// lattice leaves it after a quarter of an hour.
std::array<Pattern, 2> both(std::uint64_t seed, double direction, bool from_ripples, double minutes) {
  const Forcing forcing = wind(direction);
  HeightMap map(GridGeometry(0, 0, 0.002, 240, 160));
  map.add(layer::elevation, 0.0F);
  LatticeModel lattice(LatticeParameters{}, seed);
  if (from_ripples) lattice.advance(map, forcing, 900);
  RippleParameters parameters;
  parameters.border = Border::periodic;
  parameters.stochastic_share = 0.1;
  parameters.seed = seed;
  RippleModel ripples(parameters);
  HeightMap rough = map;
  RandomStream random(seed, 0);
  if (!from_ripples)
    for (float& h : rough.layer(layer::elevation))
      h = static_cast<float>(0.5 * forcing.grain.diameter * random.normal());
  return {grow(lattice, map, forcing, minutes), grow(ripples, rough, forcing, minutes)};
}

void compare(AccuracyTable& table, const std::string& name, double direction, bool from_ripples,
             double minutes) {
  const auto found = run_members(
      beds, [&](int i) { return both(static_cast<std::uint64_t>(i) + 1, direction, from_ripples, minutes); });
  const auto row = [&](const char* what, double Pattern::*figure, double scale, double part) {
    const Mean truth = mean_of(found, 0, figure);
    const Mean ours = mean_of(found, 1, figure);
    table.relative_row(fmt::format("{}, {}", what, name), scale * truth.value, scale * ours.value, part,
                       scale * std::hypot(truth.error, ours.error));
  };
  row("wavelength [mm]", &Pattern::wavelength, 1e3, 0.1);
  row("height [mm]", &Pattern::height, 1e3, 0.1);
  row("speed [mm/min]", &Pattern::speed, 6e4, 0.05);
}

}  // namespace

void comparison_rows(AccuracyTable& table) {
  table.section("Height map against the lattice bed of grains",
                "Targets are what the lattice bed does: 0.4 mm sand, friction velocity 0.45 m/s, 0.48 m x "
                "0.32 m of 2 mm, periodic, the mean of 4 beds; the statistical error is that of the "
                "difference. The height-map model runs with its defaults, the noise of single grains, and "
                "no law of the wavelength, as the lattice has none. `RippleTracker` finds wavelength, height "
                "and speed (mean of the last two minutes) in the maps of both.");
  compare(table, "5 min after 15 min of the lattice", 0, true, 5);
  compare(table, "15 min after 15 min of the lattice", 0, true, 15);
  compare(table, "5 min after 15 min of the lattice, wind at 29°", 0.5, true, 5);
  compare(table, "30 min from a flat bed", 0, false, 30);
}

}  // namespace aeolian
