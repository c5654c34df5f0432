#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/settings.hpp"

namespace aeolian {

ForecastEngine::Settings read_engine(const Parameters& parameters, const Tell&) {
  ForecastEngine::Settings settings;
  Grain& grain = settings.physics.grain;
  grain.diameter = parameters.number("grain_diameter");
  grain.density = parameters.number("grain_density");
  grain.porosity = parameters.number("porosity");
  grain.angle_of_repose = degrees_to_radians(parameters.number("angle_of_repose_deg"));
  settings.physics.splash.reptation_diameters = parameters.number("reptation_diameters");
  settings.horizons = parameters.numbers("horizons");
  settings.period = parameters.number("period");
  settings.wind.window = parameters.number("wind_window");
  settings.wind.max_gap = parameters.number("max_gap");
  settings.learner.emplace();
  settings.ensemble.member_cell = 0.004;
  return settings;
}

}  // namespace aeolian
