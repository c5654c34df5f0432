#include "aeolian_core/twin/forecast_ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/surface/resample.hpp"
#include "aeolian_core/surface/thinning.hpp"
#include "aeolian_core/twin/forecast_spread.hpp"
#include "aeolian_core/twin/map_error.hpp"

namespace aeolian {
namespace {

/// Another for each forecast: errors of the wind and of the map are drawn anew.
std::uint64_t number_of(const std::vector<WindSpell>& wind) {
  std::uint64_t bits = 0;
  const double time = wind.front().samples.front().time;
  std::memcpy(&bits, &time, sizeof bits);
  return bits;
}

/// On cells of the largest multiple of the map's that is not above `cell` [m]; of a map that repeats, that
/// also divides it.
HeightMap coarsened(const HeightMap& map, double cell, bool repeats) {
  const GridGeometry& g = map.geometry();
  int factor = cells_within(g, cell);
  while (repeats && (g.nx() % factor != 0 || g.ny() % factor != 0)) --factor;
  return factor == 1 ? map : resample(map, thinned(g, factor));
}

/// The mean forcing to a lead time [s].
Forcing mean_until(const std::vector<ForcingSpell>& spells, double lead_time) {
  std::vector<Forcing> forcings;
  std::vector<double> durations;
  double begin = 0;
  for (const ForcingSpell& spell : spells) {
    if (begin >= lead_time) break;
    forcings.push_back(spell.forcing);
    durations.push_back(std::min(spell.until, lead_time) - begin);
    begin = spell.until;
  }
  return mean_forcing(forcings, durations);
}

/// What a forecast starts from, without other layers.
HeightMap start_of(const HeightMap& map) {
  HeightMap start(map.geometry());
  for (const auto& name : {layer::elevation, layer::ground, layer::variance})
    if (map.has(name)) start.add(name, map.layer(name));
  return start;
}

}  // namespace

/// How a member's wind differs from that given.
struct ForecastEnsemble::Disturbance {
  double wind = 1;  ///< factor
  double turn = 0;  ///< [rad]
};

ForecastEnsemble::ForecastEnsemble(TwinPhysics physics, const Settings& settings)
    : physics_(std::move(physics)), settings_(settings) {
  constexpr Require require{"ensemble"};
  const auto not_negative = [&](double value, const char* name) {
    require(value >= 0 && std::isfinite(value), name, value, "zero or more and finite");
  };
  not_negative(settings.member_cell, "cell of members");
  not_negative(settings.map_error_length, "length of map errors");
  require(settings.wind_error >= 0 && settings.wind_error <= 1, "error of the wind", settings.wind_error,
          "0 to 1");
  require(settings.direction_error >= 0 && settings.direction_error <= M_PI, "error of the wind's direction",
          settings.direction_error, "0 to 180 degrees");
  not_negative(settings.model_error_speed, "growth of the model's error");
  check(physics_.grain);
  RippleModel(physics_.ripple);  // refuses what it does not allow
}

ForecastEnsemble::Disturbance ForecastEnsemble::disturbance(std::uint64_t forecast,
                                                            std::size_t member) const {
  RandomStream random(settings_.seed + member, forecast);
  const double wind = settings_.wind_error * random.normal();
  const double turn = settings_.direction_error * random.normal();
  return {std::exp(wind), turn};
}

std::vector<ForcingSpell> ForecastEnsemble::forcings(const std::vector<WindSpell>& wind,
                                                     const UncertainParameters& parameters) const {
  std::vector<ForcingSpell> result;
  for (const WindSpell& spell : wind)
    result.push_back({spell.until, forcing_of(physics_, spell, parameters)});
  return result;
}

/// The start with an error that it may have.
HeightMap ForecastEnsemble::disturbed(const HeightMap& start, std::uint64_t forecast,
                                      std::size_t member) const {
  HeightMap result = start;
  if (!start.has(layer::variance)) return result;
  const HeightMap::Layer noise =
      smooth_noise(start.geometry(), settings_.map_error_length, settings_.seed + member, ~forecast);
  const HeightMap::Layer& variance = start.layer(layer::variance);
  HeightMap::Layer& elevation = result.layer(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    if (variance[i] > 0 && std::isfinite(variance[i])) elevation[i] += noise[i] * std::sqrt(variance[i]);
  if (!start.has(layer::ground)) return result;
  const HeightMap::Layer& ground = start.layer(layer::ground);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    if (elevation[i] < ground[i]) elevation[i] = ground[i];
  return result;
}

EnsembleForecast ForecastEnsemble::run(const HeightMap& start, const std::vector<WindSpell>& wind,
                                       const std::vector<double>& horizons,
                                       const std::vector<UncertainParameters>& members,
                                       const UncertainParameters& median) const {
  constexpr Require require{"ensemble"};
  require(!wind.empty(), "number of spells of wind", 0, "one or more");
  const auto run_model = [&](const HeightMap& from, const std::vector<ForcingSpell>& forcing,
                             const UncertainParameters& parameters) {
    RippleModel model(ripple_parameters(physics_, parameters));
    return make_forecasts_in_turn(from, forcing, horizons, model);
  };
  EnsembleForecast result;
  const std::vector<ForcingSpell> control = forcings(wind, median);
  if (members.empty()) {
    result.forecasts = run_model(start, control, median);
    return result;
  }

  const HeightMap coarse =
      coarsened(start_of(start), settings_.member_cell, physics_.ripple.border == Border::periodic);
  const std::uint64_t number = number_of(wind);
  result.member_geometry = coarse.geometry();
  result.members.resize(members.size());
  const auto run_member = [&](std::size_t member) {
    const Disturbance change = disturbance(number, member);
    UncertainParameters parameters = members[member];
    parameters.friction_velocity *= change.wind;
    std::vector<ForcingSpell> forcing = forcings(wind, parameters);
    for (ForcingSpell& spell : forcing) spell.forcing.direction += change.turn;
    result.members[member].parameters = members[member];
    for (Forecast& each : run_model(disturbed(coarse, number, member), forcing, parameters))
      result.members[member].elevation.push_back(std::move(each.map.layer(layer::elevation)));
  };
  // The longest run first.
  tbb::parallel_for(std::size_t{0}, members.size() + 1, [&](std::size_t task) {
    if (task == 0)
      result.forecasts = run_model(start, control, median);
    else
      run_member(task - 1);
  });

  for (std::size_t h = 0; h < horizons.size(); ++h) {
    std::vector<const HeightMap::Layer*> elevations;
    for (const MemberForecast& member : result.members) elevations.push_back(&member.elevation[h]);
    Forecast& forecast = result.forecasts[h];
    const double model_error =
        forecast.volume.moved > 0 ? settings_.model_error_speed * std::sqrt(forecast.lead_time) : 0;
    BorderError border;
    if (physics_.ripple.border == Border::open)
      border = border_error(forecast, mean_until(control, forecast.lead_time), physics_.ripple.hop_shortening,
                            physics_.ripple.slope_effect);
    forecast.map.add(layer::spread, spread_of(elevations, coarse.geometry(), model_error, border, start));
  }
  return result;
}

}  // namespace aeolian
