#include "aeolian_twin/saltation/mixture_files.hpp"

#include "aeolian_core/saltation/saltation_table.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/photo/yaml_figures.hpp"
#include "aeolian_twin/saltation/saltation_files.hpp"

namespace aeolian {
namespace {

Table size_table(const MixtureRun& run) {
  Table table{{"diameter_mm", "share", "mass_flux_kg_m_s", "impact_rate_m2_s", "grain_stress_Pa",
               "mean_impact_speed_m_s", "mean_impact_angle_deg", "mean_hop_length_m", "mean_hop_height_m"},
              std::vector<std::vector<double>>(9)};
  for (std::size_t s = 0; s < run.state.sizes.size(); ++s) {
    const SteadyState& size = run.state.sizes[s];
    const SaltationState means = summary(size, 0);
    const double row[] = {1e3 * run.mixture.diameter[s],
                          run.mixture.share[s],
                          means.mass_flux,
                          means.impact_rate,
                          size.grain_stress[0],
                          means.impact_speed,
                          radians_to_degrees(means.impact_angle),
                          means.hop_length,
                          means.hop_height};
    for (std::size_t c = 0; c < table.columns.size(); ++c) table.columns[c].push_back(row[c]);
  }
  return table;
}

}  // namespace

void write_mixture(const MixtureRun& run, const std::string& folder) {
  write_csv(size_table(run), folder + "/mixture.csv");
  const SteadyState& any = run.state.sizes.front();
  YAML::Emitter out;
  out << YAML::BeginMap;
  out.SetDoublePrecision(summary_digits);
  put(out, "outcome", outcome_word(any.outcome));
  if (!any.reason.empty()) put(out, "reason", any.reason);
  put(out, "mean_diameter_m", run.mixture.mean_diameter());
  put(out, "friction_velocity_m_s", any.friction_velocity);
  put(out, "surface_friction_velocity_m_s", any.surface_friction_velocity);
  put(out, "mass_flux_kg_m_s", run.state.mass_flux());
  put(out, "impact_rate_m2_s", run.state.impact_rate());
  if (run.impact_threshold)
    put(out, "impact_threshold_m_s", *run.impact_threshold);
  else
    put(out, "no_impact_threshold", run.no_threshold);
  out << YAML::EndMap;
  write_text_atomically(folder + "/mixture.yaml", std::string(out.c_str()) + "\n");
}

}  // namespace aeolian
