#include "aeolian_core/twin/forecast_scorer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_core/twin/on_grid.hpp"

namespace aeolian {
namespace {

constexpr std::size_t most_winds = 100000;  // some hours of readings

double to_nanosecond(double time) { return std::round(time * 1e9) / 1e9; }

/// To a microsecond, as the layer holds floats.
double lead_time(const HeightMap& forecast) {
  for (const float t : forecast.layer(layer::lead_time))
    if (std::isfinite(t)) return std::round(static_cast<double>(t) * 1e6) / 1e6;
  throw Error("forecast: layer 'lead_time' has no known cell");
}

}  // namespace

void ForecastScorer::take_wind(const WindSample& sample) {
  wind_.push_back(sample);
  if (wind_.size() > most_winds) wind_.pop_front();
}

ForecastScorer::Taken ForecastScorer::take_forecast(std::shared_ptr<const HeightMap> forecast, double time) {
  Taken taken;
  pending_.push_back({time, std::move(forecast)});
  if (pending_.size() > settings_.max_pending) {
    pending_.pop_front();
    taken.oldest_dropped = true;
  }
  taken.scores = score_due();
  return taken;
}

ForecastScorer::Taken ForecastScorer::take_map(std::shared_ptr<const HeightMap> map, double time) {
  Taken taken;
  if (!maps_.empty() && time < maps_.back().time) {
    taken.begun_anew = pending_.size();
    pending_.clear();
    maps_.clear();
    wind_.clear();
  }
  maps_.push_back({time, std::move(map)});
  if (maps_.size() > settings_.max_maps) maps_.pop_front();
  taken.scores = score_due();
  return taken;
}

/// Scores the forecasts whose time has come: the nearest map is known once one at or after has arrived.
std::vector<ForecastScorer::Score> ForecastScorer::score_due() {
  std::vector<Score> scores;
  if (maps_.empty()) return scores;
  const double newest = maps_.back().time;
  const auto first_due = std::stable_partition(pending_.begin(), pending_.end(),
                                               [&](const Timed& forecast) { return forecast.time > newest; });
  for (auto forecast = first_due; forecast != pending_.end(); ++forecast) scores.push_back(score(*forecast));
  pending_.erase(first_due, pending_.end());
  return scores;
}

ForecastScorer::Score ForecastScorer::score(const Timed& pending) {
  Score result;
  result.time = pending.time;
  try {
    const Timed& measured = nearest_map(pending.time);
    result.measured_time = measured.time;
    const GridGeometry& geometry = measured.map->geometry();
    const HeightMap forecast = on_grid(*pending.map, geometry);
    const HeightMap::Layer& heights = measured.map->layer(layer::elevation);
    result.issued = to_nanosecond(pending.time - lead_time(forecast));
    result.comparison = compare(geometry, forecast.layer(layer::elevation), heights,
                                forecast.layer(layer::initial), wind_direction(result.issued, pending.time));
    result.difference = difference_map(forecast, *measured.map, std::exchange(spare_, {}));
    result.difference.add(layer::elevation, heights);
    result.difference.add(layer::lead_time, forecast.layer(layer::lead_time));
  } catch (const Error& error) {
    result.refused = error.what();
  }
  return result;
}

const ForecastScorer::Timed& ForecastScorer::nearest_map(double time) const {
  const auto distance = [&](const Timed& map) { return to_nanosecond(std::abs(map.time - time)); };
  const Timed& nearest = *std::min_element(
      maps_.begin(), maps_.end(), [&](const Timed& a, const Timed& b) { return distance(a) < distance(b); });
  if (distance(nearest) > settings_.tolerance)
    throw Error(fmt::format("the nearest map is {:.2f} s away, must be within {} s (~tolerance)",
                            distance(nearest), settings_.tolerance));
  return nearest;
}

/// Mean over an interval, weighted by friction velocity; that of the settings when no wind is known there.
double ForecastScorer::wind_direction(double from, double to) const {
  double east = 0;
  double north = 0;
  for (const WindSample& sample : wind_) {
    if (sample.time < from || sample.time > to) continue;
    east += sample.friction_velocity * std::cos(sample.direction);
    north += sample.friction_velocity * std::sin(sample.direction);
  }
  return east == 0 && north == 0 ? settings_.direction : std::atan2(north, east);
}

}  // namespace aeolian
