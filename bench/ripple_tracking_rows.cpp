#include <algorithm>
#include <cmath>

#include "ripple_rows.hpp"

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/measure/ripple_tracking.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// Half an hour of ripples on 0.8 m x 0.4 m from a bed that is rough by half a grain, a map every half
/// minute.
RippleHistory grown_ripples(double friction_velocity, std::uint64_t seed) {
  constexpr double direction = 0.2;
  constexpr double interval = 20;
  const GridGeometry g(0, 0, 0.002, 400, 200);
  Grain grain;
  grain.diameter = 3e-4;
  const Forcing forcing =
      make_forcing(steady_saltation(friction_velocity, grain), direction, grain, MeanSplash{});
  RippleParameters parameters;
  parameters.border = Border::periodic;
  RippleModel model(parameters);
  RandomStream random(seed, 0);
  std::vector<double> height(g.size());
  for (double& h : height) h = 0.5 * grain.diameter * random.normal();
  RippleTracker tracker(direction, grain.diameter);
  for (double time = 0; time <= 1800; time += interval) {
    if (time > 0) model.advance(g, height, forcing, interval);
    tracker.add(g, HeightMap::Layer(height.begin(), height.end()), time);
  }
  return tracker.history();
}

double degrees(const Figure& angle) { return angle.value * 180 / M_PI; }

}  // namespace

void tracking_rows(AccuracyTable& table) {
  table.section(
      "Ripples followed over time (rows 31, 32)",
      "Height-map model, 0.3 mm sand, friction velocity 0.7 m/s (the field's wind while its ripples grew), "
      "30 min "
      "from a flat bed that is rough by half a grain, 0.8 m x 0.4 m of 2 mm, a map every 20 s; what "
      "`RippleTracker` finds in the maps alone. Repulsions are rare in the model, which is deterministic: "
      "none in "
      "30 min of 0.4 mm sand at 0.45 m/s. Shapes are medians over all crests of the last map; slopes are the "
      "steepest over a tenth of a wavelength, as in the thesis' table 5.1.");
  const RippleHistory history = grown_ripples(0.7, 1);
  for (const RippleChange kind : {RippleChange::merger, RippleChange::repulsion, RippleChange::split}) {
    const auto found = std::count_if(history.events.begin(), history.events.end(),
                                     [&](const RippleEvent& event) { return event.kind == kind; });
    table.statement(fmt::format("{}s occur and are found", name_of(kind)), fmt::format("{}", found),
                    found > 0);
  }
  const RippleField& field = history.maps.back().field;
  table.range_row("index", 15, 20, field.index.value, field.index.sigma);
  table.range_row("stoss slope [°]", 5, 11, degrees(field.stoss_max), degrees({field.stoss_max.sigma, 0}));
  table.range_row("lee slope [°]", 8, 35, degrees(field.lee_max), degrees({field.lee_max.sigma, 0}));
  table.remark("wavelength [mm] (field, 15 min: 70)", 70, 1e3 * field.wavelength.value,
               1e3 * field.wavelength.sigma);
}

}  // namespace aeolian
