#include "aeolian_core/twin/forecast.hpp"

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
  if (!start.has(layer::elevation)) throw Error("forecast: the start has no layer elevation");
  const HeightMap::Layer& initial = start.layer(layer::elevation);
  if (count_known(initial) == 0) throw Error("forecast: no cell of the start is known");

  HeightMap bed(start.geometry());
  bed.add(layer::elevation, initial);
  if (start.has(layer::ground)) bed.add(layer::ground, start.layer(layer::ground));
  VolumeBalance volume;
  double time = 0;
  std::vector<Forecast> forecasts;
  for (const double horizon : horizons) {
    add(volume, model.advance(bed, forcing, horizon - time).volume);
    time = horizon;
    HeightMap map(start.geometry());
    map.add(layer::elevation, bed.layer(layer::elevation));
    map.add(layer::initial, initial);
    map.add(layer::lead_time, where_known(initial, horizon));
    forecasts.push_back({horizon, std::move(map), volume});
  }
  return forecasts;
}

}  // namespace aeolian
