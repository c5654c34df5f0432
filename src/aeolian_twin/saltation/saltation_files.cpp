#include "aeolian_twin/saltation/saltation_files.hpp"

#include <cmath>

#include "aeolian_core/saltation/flux_response.hpp"
#include "aeolian_core/saltation/saltation_table.hpp"
#include "aeolian_core/saltation/thresholds.hpp"
#include "aeolian_core/surface/atomic_file.hpp"
#include "aeolian_core/surface/csv.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/photo/yaml_figures.hpp"

namespace aeolian {
namespace {

Table profile_table(const SaltationProfiles& p, double grain_mass) {
  std::vector<double> mass_flux(p.number_flux);
  for (double& value : mass_flux) value *= grain_mass;
  return {{"height_m", "wind_m_s", "undisturbed_wind_m_s", "number_density_m3", "number_flux_m2_s",
           "mass_flux_kg_m2_s", "kinetic_energy_flux_W_m2", "number_flux_of_cubed_speed_s3", "drag_N_m3"},
          {p.height, p.wind, p.undisturbed_wind, p.number_density, p.number_flux, mass_flux, p.kinetic_flux,
           p.cubed_flux, p.drag}};
}

Table wind_table(const SteadyState& s) {
  Table table{{"height_m", "wind_m_s", "shear_velocity_m_s", "grain_stress_Pa"}, {{}, {}, {}, {}}};
  for (std::size_t i = 0; i < WindProfile::levels; ++i) {
    table.columns[0].push_back(s.wind.height(i));
    table.columns[1].push_back(s.wind.speed_at_level(i));
    table.columns[2].push_back(s.wind.shear_velocity(i));
    table.columns[3].push_back(s.grain_stress[i]);
  }
  return table;
}

Table launch_table(const SteadyState& s) {
  Table table{{"launch_vx_m_s", "launch_vy_m_s", "rate_m2_s", "impact_vx_m_s", "impact_vy_m_s",
               "impact_speed_m_s", "impact_angle_deg", "hop_length_m", "hop_height_m", "flight_time_s"},
              std::vector<std::vector<double>>(10)};
  for (std::size_t k = 0; k < s.launches.size(); ++k) {
    if (!(s.launches.number[k] > 0)) continue;
    const double vx = s.landings.vx[k];
    const double vy = s.landings.vy[k];
    const double row[] = {s.launches.vx[k],
                          s.launches.vy[k],
                          s.launches.number[k],
                          vx,
                          vy,
                          std::hypot(vx, vy),
                          radians_to_degrees(std::atan2(vy, vx)),
                          s.landings.length[k],
                          s.landings.apex[k],
                          s.landings.duration[k]};
    for (std::size_t c = 0; c < table.columns.size(); ++c) table.columns[c].push_back(row[c]);
  }
  return table;
}

double mean_of(const std::vector<double>& time, const std::vector<double>& value) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < time.size(); ++i)
    sum += 0.5 * (value[i] + value[i + 1]) * (time[i + 1] - time[i]);
  return sum / (time.back() - time.front());
}

void put_state(YAML::Emitter& out, const SolvedWind& wind) {
  const SteadyState& s = wind.state;
  const SaltationState means = summary(s, 0);
  put(out, "outcome", outcome_word(s.outcome));
  if (!s.reason.empty()) put(out, "reason", s.reason);
  put(out, "friction_velocity_m_s", s.friction_velocity);
  put(out, "surface_friction_velocity_m_s", s.surface_friction_velocity);
  put(out, "mass_flux_kg_m_s", means.mass_flux);
  put(out, "impact_rate_m2_s", means.impact_rate);
  put(out, "mean_impact_speed_m_s", means.impact_speed);
  put(out, "mean_impact_angle_deg", radians_to_degrees(means.impact_angle));
  put(out, "mean_hop_length_m", means.hop_length);
  put(out, "mean_hop_height_m", means.hop_height);
  put(out, "mean_flight_time_s", means.flight_time);
  put(out, "means", "over grains that land");
  put(out, "median_height_of_flux_m", wind.profiles.median_height(wind.profiles.number_flux));
  put(out, "apparent_roughness_m", means.apparent_roughness);
  put(out, "iterations", s.iterations);
  put(out, "grains_leaving_for_one_landing", s.replacement);
}

}  // namespace

const char* outcome_word(SteadyState::Outcome outcome) {
  switch (outcome) {
    case SteadyState::Outcome::steady:
      return "steady";
    case SteadyState::Outcome::below_threshold:
      return "below_threshold";
    default:
      return "none";
  }
}

void write_saltation_tables(const SaltationRun& run, const std::string& folder) {
  const SolvedWind& wind = run.asked();
  write_csv(profile_table(wind.profiles, wind.state.grain_mass), folder + "/profiles.csv");
  write_csv(wind_table(wind.state), folder + "/wind.csv");
  write_csv(launch_table(wind.state), folder + "/launches.csv");
}

void write_state(const SolvedWind& wind, const std::string& path) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out.SetDoublePrecision(summary_digits);
  put_state(out, wind);
  out << YAML::EndMap;
  write_text_atomically(path, std::string(out.c_str()) + "\n");
}

void write_gusts(const GustRun& g, const std::string& folder) {
  Table table{{"t_s", "friction_velocity_m_s", "steady_flux_kg_m_s", "relaxed_flux_kg_m_s"},
              {g.time, g.friction_velocity, g.steady, g.relaxed}};
  if (!g.in_time.empty()) {
    table.names.push_back("flux_solved_in_time_kg_m_s");
    table.columns.push_back(g.in_time);
  }
  write_csv(table, folder + "/gusts.csv");
}

void write_saltation_summary(const SaltationRun& run, const std::optional<GustRun>& gusts,
                             const std::string& folder) {
  YAML::Emitter out;
  out << YAML::BeginMap;
  out.SetDoublePrecision(summary_digits);
  put(out, "splash", run.splash);
  out << YAML::Key << "bed" << YAML::Value << YAML::BeginMap;
  put(out, "grain_diameter_m", run.bed.grain.diameter);
  put(out, "grain_density_kg_m3", run.bed.grain.density);
  put(out, "air_density_kg_m3", run.bed.atmosphere.density);
  put(out, "air_viscosity_m2_s", run.bed.atmosphere.viscosity);
  put(out, "gravity_m_s2", run.bed.atmosphere.gravity);
  put(out, "roughness_length_m", run.bed.roughness_length());
  put(out, "drag_law", run.bed.drag_law == DragLaw::sand ? "sand" : "sphere");
  put(out, "drag_scale", run.bed.drag_scale);
  out << YAML::EndMap;
  out << YAML::Key << "thresholds" << YAML::Value << YAML::BeginMap;
  if (run.impact_threshold)
    put(out, "impact_threshold_m_s", *run.impact_threshold);
  else
    put(out, "no_impact_threshold", run.no_threshold);
  put(out, "fluid_threshold_m_s", run.bed.fluid_threshold());
  out << YAML::EndMap;
  out << YAML::Key << "state" << YAML::Value << YAML::BeginMap;
  put_state(out, run.asked());
  out << YAML::EndMap;
  put(out, "saturation_length_m", saturation_length(run.bed));
  if (run.law) {
    out << YAML::Key << "flux_law" << YAML::Value << YAML::BeginMap;
    put(out, "form", "Q = A (u^2 - u_it^2) (1 + B (u / u_it - 1))");
    put(out, "A_kg_s_m3", run.law->amplitude);
    put(out, "B", run.law->correction);
    out << YAML::EndMap;
  }
  if (gusts) {
    out << YAML::Key << "gusts" << YAML::Value << YAML::BeginMap;
    put(out, "duration_s", gusts->time.back() - gusts->time.front());
    put(out, "mean_steady_flux_kg_m_s", mean_of(gusts->time, gusts->steady));
    put(out, "mean_relaxed_flux_kg_m_s", mean_of(gusts->time, gusts->relaxed));
    if (!gusts->in_time.empty())
      put(out, "mean_flux_solved_in_time_kg_m_s", mean_of(gusts->time, gusts->in_time));
    out << YAML::EndMap;
  }
  out << YAML::EndMap;
  write_text_atomically(folder + "/summary.yaml", std::string(out.c_str()) + "\n");
}

}  // namespace aeolian
