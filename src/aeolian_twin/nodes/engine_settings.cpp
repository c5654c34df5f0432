#include "aeolian_twin/nodes/engine_settings.hpp"

#include <algorithm>
#include <filesystem>
#include <functional>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_core/wind/wind_record.hpp"

namespace aeolian {
namespace {

const std::string law = "law";     // name of the three-number law
constexpr int fewest_members = 8;  // that tell a spread and that a learner takes

std::string sigma_of(std::size_t parameter) { return UncertainParameters::names()[parameter] + "_sigma"; }

/// The law or a table. A file that cannot be used is told, and the law is used.
SaltationSource read_saltation(const std::string& name, const Tell& tell) {
  if (name == law) return {};
  try {
    SaltationSource solved(SaltationTable::read(name));
    tell("saltation", true, "states of " + name);
    return solved;
  } catch (const Error& error) {
    tell("saltation", false, fmt::format("{}; the three-number law is used", error.what()));
    return {};
  }
}

TwinPhysics read_physics(const Parameters& parameters, const Tell& tell) {
  TwinPhysics physics;
  physics.grain.diameter = parameters.number("grain_diameter");
  physics.grain.density = parameters.number("grain_density");
  physics.grain.porosity = parameters.number("porosity");
  physics.grain.angle_of_repose = degrees_to_radians(parameters.number("angle_of_repose_deg"));
  check(physics.grain);
  physics.saltation = read_saltation(parameters.text("saltation"), tell);
  physics.splash.reptation_diameters = parameters.number("reptation_diameters");
  RippleParameters& ripple = physics.ripple;
  ripple.hop_shortening = parameters.number("hop_shortening");
  ripple.slope_effect = parameters.number("slope_effect");
  ripple.doubling_slope = degrees_to_radians(parameters.number("doubling_slope_deg"));
  ripple.wavelength_law =
      make_wavelength_law(parameters.text("wavelength_law"), parameters.number("wavelength_diameters"));
  const std::string& inflow = parameters.text("inflow");
  ripple.inflow = inflow == "none" ? Inflow::none : inflow == "ripples" ? Inflow::ripples : Inflow::flat_bed;
  ripple.lateral_spread = parameters.number("lateral_spread");
  ripple.relief_scale = parameters.number("relief_scale");
  return physics;
}

ParameterLearner::Settings read_learner(const Parameters& parameters, std::size_t members) {
  ParameterLearner::Settings learner;
  learner.members = members;
  learner.seed = static_cast<std::uint64_t>(parameters.integer("seed"));
  learner.frozen = parameters.text("learning") == "frozen";
  for (std::size_t i = 0; i < learner.priors.size(); ++i)
    learner.priors[i].sigma = parameters.number(sigma_of(i));
  return learner;
}

}  // namespace

double bed_roughness(const Parameters& parameters) {
  return grain_roughness(parameters.number("grain_diameter"));
}

ForecastEngine::Settings read_engine(const Parameters& parameters, const Tell& tell) {
  ForecastEngine::Settings settings;
  settings.horizons = parameters.numbers("horizons");
  const auto& horizons = settings.horizons;
  if (horizons.empty() ||
      std::adjacent_find(horizons.begin(), horizons.end(), std::greater_equal<>()) != horizons.end())
    parameters.refuse("horizons", "a list of at least one time, each longer than the one before");
  settings.period = parameters.number("period");
  settings.wind.window = parameters.number("wind_window");
  settings.wind.max_gap = parameters.number("max_gap");
  settings.wind.max_friction_velocity = parameters.number("max_friction_velocity");
  settings.physics = read_physics(parameters, tell);
  ForecastEnsemble::Settings& ensemble = settings.ensemble;
  ensemble.member_cell = parameters.number("member_cell");
  ensemble.map_error_length = parameters.number("map_error_length");
  ensemble.wind_error = parameters.number("wind_error");
  ensemble.direction_error = degrees_to_radians(parameters.number("direction_error_deg"));
  ensemble.model_error_speed = parameters.number("model_error_speed");
  ensemble.seed = static_cast<std::uint64_t>(parameters.integer("seed"));
  const int members = parameters.integer("members");
  if (members > 0 && members < fewest_members) parameters.refuse("members", "0, or 8 and more");
  if (members > 0) settings.learner = read_learner(parameters, static_cast<std::size_t>(members));
  settings.learning = parameters.text("learning") != "off";
  settings.learning_period = parameters.number("learning_period");
  return settings;
}

void prepare_engine(const Parameters& parameters, ForecastEngine& engine, const Tell& tell) {
  const std::string& learned = parameters.text("learned_file");
  if (engine.learner() && !learned.empty() && std::filesystem::exists(learned)) {
    engine.learner()->load(learned);
    tell("learning", true,
         fmt::format("goes on from {} updates of {}", engine.learner()->state().updates, learned));
  }
  const std::string& ahead = parameters.text("wind_ahead_file");
  if (ahead.empty()) return;
  const WindRecord record = read_wind_record(ahead);
  std::vector<WindSample> samples;
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    WindSample sample;
    sample.time = record.time[i];
    sample.friction_velocity =
        friction_velocity(record.speed[i], parameters.number("wind_ahead_height"), bed_roughness(parameters));
    sample.direction = record.direction[i];
    samples.push_back(sample);
  }
  try {
    engine.give_wind_ahead(std::move(samples));
  } catch (const Error& error) {
    throw Error(fmt::format("wind record {}: {}", ahead, error.what()));
  }
  tell("wind ahead", true, fmt::format("{} samples of {}", record.time.size(), ahead));
}

std::vector<ParameterDeclaration> engine_parameters() {
  const Grain grain;
  const RippleParameters ripple;
  const ForecastEnsemble::Settings ensemble;
  const ForecastEngine::Settings engine;
  std::vector<ParameterDeclaration> declarations{
      {"grain_diameter", grain.diameter, "m", "of the bed", Limits::between(1e-5, 1e-2)},
      {"grain_density", grain.density, "kg/m^3", "of the solid", Limits::positive()},
      {"porosity", grain.porosity, "", "of the bed at rest", Limits::between(0, 0.95)},
      {"angle_of_repose_deg", 33.0, "degrees", "of the bed", Limits::between(1, 60)},
      {"saltation", law, "", "law (of three numbers), or the path of a table of solved states"},
      {"reptation_diameters", MeanSplash{}.reptation_diameters, "grain diameters",
       "mean length of a reptation hop", Limits::positive()},
      {"hop_shortening", ripple.hop_shortening, "", "hops end early by this share of the bed's rise",
       Limits::not_negative()},
      {"slope_effect", ripple.slope_effect, "", "downslope bias of reptation", Limits::not_negative()},
      {"doubling_slope_deg", 22.0, "degrees", "slope at which the downslope bias has doubled",
       Limits::between(1, 90)},
      {"wavelength_law",
       std::string("constant"),
       "",
       "where ripples stop growing: nowhere, alike in every wind, or linear in the friction velocity",
       {},
       {"none", "constant", "linear"}},
      {"wavelength_diameters", 250.0, "grain diameters",
       "final wavelength; of the linear law, at twice the impact threshold", Limits::positive()},
      {"inflow",
       std::string("flat_bed"),
       "",
       "what comes in from upwind: as from a flat bed, nothing, or a random train of ripples",
       {},
       {"flat_bed", "none", "ripples"}},
      {"lateral_spread", ripple.lateral_spread, "", "spread of a hop across the wind / mean length",
       Limits::not_negative()},
      {"relief_scale", ripple.relief_scale, "m", "heights count above the surface smoothed over this",
       Limits::positive()},
      {"horizons", engine.horizons, "s", "lead times of the forecasts, increasing", Limits::positive()},
      {"period", engine.period, "s", "between forecasts, by the stamps of the maps", Limits::positive()},
      {"wind_window", 300.0, "s", "the wind of so long before the map goes on blowing", Limits::positive()},
      {"max_gap", engine.wind.max_gap, "s", "longer times without wind are reported", Limits::positive()},
      {"max_friction_velocity", engine.wind.max_friction_velocity, "m/s",
       "what is above is a spike: left out", Limits::positive()},
      {"wind_ahead_file", std::string(), "",
       "CSV of the wind to come: t_s since the epoch, speed_m_s and "
       "direction_deg or from_deg; empty: none"},
      {"wind_ahead_height", 1.0, "m", "over the ground, of the speeds in that file", Limits::positive()},
      {"members", 20, "", "forecasts that tell the uncertainty; 0: one forecast without it",
       Limits::between(0, 1000)},
      {"member_cell", 0.006, "m", "members run on cells of up to this; 0: as the map",
       Limits::not_negative()},
      {"map_error_length", ensemble.map_error_length, "m", "over which errors of the map are alike",
       Limits::not_negative()},
      {"wind_error", ensemble.wind_error, "", "of the wind to come, a share of the friction velocity",
       Limits::between(0, 1)},
      {"direction_error_deg", 3.0, "degrees", "of the wind to come", Limits::between(0, 180)},
      {"model_error_speed", ensemble.model_error_speed, "m/sqrt(s)", "growth of the model's own error",
       Limits::not_negative()},
      {"seed", 1, "", "decides everything random", Limits::not_negative()},
      {"learning",
       std::string("off"),
       "",
       "from misses: on, frozen (misses are only watched), or off",
       {},
       {"on", "frozen", "off"}},
      {"learning_period", engine.learning_period, "s", "at least, from one map learned from to the next",
       Limits::positive()},
      {"learned_file", std::string(), "", "YAML: read at the start, written after each lesson; empty: none"},
  };
  const ParameterPriors priors = default_priors();
  for (std::size_t i = 0; i < priors.size(); ++i)
    declarations.push_back({sigma_of(i), priors[i].sigma, "",
                            "how well that is known before anything is learned: a share of it",
                            Limits::between(0, 2)});
  return declarations;
}

}  // namespace aeolian
