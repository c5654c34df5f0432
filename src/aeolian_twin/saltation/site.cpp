#include "aeolian_twin/saltation/site.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "aeolian_core/saltation/flux_response.hpp"
#include "aeolian_core/saltation/supplied_state.hpp"
#include "aeolian_core/saltation/thresholds.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/photo/yaml_figures.hpp"
#include "aeolian_twin/saltation/splash_choice.hpp"

namespace aeolian {

SiteRun at_site(const SaltationRun& run, const SiteConditions& conditions) {
  const double repose = run.bed.grain.angle_of_repose;
  if (!(std::abs(conditions.slope) < repose))
    throw Error(fmt::format("--slope-deg: {0:g}, must be between -{1:.3g} and {1:.3g}, the angle of repose",
                            radians_to_degrees(conditions.slope), radians_to_degrees(repose)));
  if (!run.law)
    throw Error(
        "the flux of the site: needs a flux law, but grains do not saltate well above the "
        "threshold at this --friction-velocity");
  SiteRun site;
  site.conditions = conditions;
  const double factor = slope_factor(conditions.slope, repose);
  site.impact_threshold = factor * run.law->threshold;
  site.fluid_threshold =
      factor * (conditions.cohesion ? cohesive_fluid_threshold(run.bed, *conditions.cohesion)
                                    : run.bed.fluid_threshold());
  const double wind = run.asked().state.friction_velocity;
  site.starts = wind > std::max(site.fluid_threshold, site.impact_threshold);
  FluxLaw law = *run.law;
  law.threshold = site.impact_threshold;
  site.saturated_flux = law.flux(wind);
  site.flux = conditions.fetch
                  ? flux_at_fetch(site.saturated_flux, *conditions.fetch, saturation_length(run.bed))
                  : site.saturated_flux;
  return site;
}

void write_site(const SiteRun& run, const std::string& folder) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out.SetDoublePrecision(summary_digits);
  put(out, "slope_deg", radians_to_degrees(run.conditions.slope));
  if (run.conditions.cohesion) put(out, "cohesion_N_m", *run.conditions.cohesion);
  if (run.conditions.fetch) put(out, "fetch_m", *run.conditions.fetch);
  put(out, "impact_threshold_m_s", run.impact_threshold);
  put(out, "fluid_threshold_m_s", run.fluid_threshold);
  put(out, "starts_without_grains_from_upwind", run.starts);
  put(out, "saturated_flux_kg_m_s", run.saturated_flux);
  put(out, "mass_flux_kg_m_s", run.flux);
  out << YAML::EndMap;
  write_text_atomically(folder + "/site.yaml", std::string(out.c_str()) + "\n");
}

SolvedWind over_hard_ground(const SaltatingBed& bed, double friction_velocity, double flux) {
  SteadyState state = supplied_state(bed, *hard_ground_choice(bed), friction_velocity, flux);
  SaltationProfiles layers = profiles(state, bed);
  return {std::move(state), std::move(layers)};
}

}  // namespace aeolian
