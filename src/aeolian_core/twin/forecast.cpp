#include "aeolian_core/twin/forecast.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

void require_horizons(const std::vector<double>& horizons) {
  if (horizons.empty()) throw Error("forecast: there is no horizon");
  double last = 0;
  for (const double horizon : horizons) {
    if (!(horizon > last) || !std::isfinite(horizon))
      throw Error("forecast: horizon " + std::to_string(horizon) + " s after " + std::to_string(last) +
                  " s, horizons must be positive and increase");
    last = horizon;
  }
}

void require_spells(const std::vector<ForcingSpell>& forcings, double horizon) {
  double last = 0;
  for (const ForcingSpell& spell : forcings) {
    if (!(spell.until > last))
      throw Error("forecast: wind until " + std::to_string(spell.until) + " s after " + std::to_string(last) +
                  " s, must increase");
    last = spell.until;
  }
  if (!(last >= horizon))
    throw Error("forecast: there is wind for " + std::to_string(last) + " s of " + std::to_string(horizon));
}

HeightMap::Layer where_known(const HeightMap::Layer& values, double value) {
  HeightMap::Layer result(values.size(), HeightMap::unknown);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::isfinite(values[i])) result[i] = static_cast<float>(value);
  return result;
}

void add(VolumeBalance& total, const VolumeBalance& part) {
  total.moved += part.moved;
  total.change += part.change;
  total.inflow += part.inflow;
  total.outflow += part.outflow;
}

}  // namespace

std::vector<Forecast> make_forecasts(const HeightMap& start, const Forcing& forcing,
                                     const std::vector<double>& horizons, BedModel& model) {
  require_horizons(horizons);
  return make_forecasts_in_turn(start, {{horizons.back(), forcing}}, horizons, model);
}

std::vector<Forecast> make_forecasts_in_turn(const HeightMap& start,
                                             const std::vector<ForcingSpell>& forcings,
                                             const std::vector<double>& horizons, BedModel& model) {
  require_horizons(horizons);
  require_spells(forcings, horizons.back());
  if (!start.has(layer::elevation)) throw Error("forecast: the start has no layer elevation");
  const HeightMap::Layer& initial = start.layer(layer::elevation);
  if (count_known(initial) == 0) throw Error("forecast: no cell of the start is known");

  HeightMap bed(start.geometry());
  bed.add(layer::elevation, initial);
  if (start.has(layer::ground)) bed.add(layer::ground, start.layer(layer::ground));
  VolumeBalance volume;
  double time = 0;
  std::vector<Forecast> forecasts;
  auto spell = forcings.begin();
  for (const double horizon : horizons) {
    while (time < horizon) {
      const double to = std::min(spell->until, horizon);
      add(volume, model.advance(bed, spell->forcing, to - time).volume);
      time = to;
      if (time == spell->until) ++spell;
    }
    HeightMap map(start.geometry());
    map.add(layer::elevation, bed.layer(layer::elevation));
    map.add(layer::initial, initial);
    map.add(layer::lead_time, where_known(initial, horizon));
    forecasts.push_back({horizon, std::move(map), volume});
  }
  return forecasts;
}

}  // namespace aeolian
