#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/saltation/flux_law.hpp"
#include "aeolian_core/saltation/profiles.hpp"

namespace aeolian {

/// One wind over one bed, solved, with its profiles.
struct SolvedWind {
  SteadyState state;
  SaltationProfiles profiles;
};

/// What a run of the program `saltation` has found.
struct SaltationRun {
  SaltatingBed bed;
  std::string splash;
  std::optional<double> impact_threshold;  ///< [m/s]
  std::string no_threshold;                ///< why there is none
  std::vector<SolvedWind> winds;  ///< weaker ones for comparison first, the one that was asked for last
  std::optional<FluxLaw> law;     ///< through all of them

  const SolvedWind& asked() const { return winds.back(); }
};

/// The flux in a recorded wind.
struct GustRun {
  std::vector<double> time, friction_velocity;  ///< [s], [m/s]
  std::vector<double> steady;   ///< flux in balance with the wind of the moment [kg m^-1 s^-1]
  std::vector<double> relaxed;  ///< with T_sat and hysteresis
  std::vector<double> in_time;  ///< by eq. 4.35; empty where it was not asked for
};

/// How an outcome is told in files: steady, below_threshold or none.
const char* outcome_word(SteadyState::Outcome outcome);

/// Writes profiles.csv (all by height), wind.csv (levels of the solver, from the roughness length upwards)
/// and launches.csv (each class of launches with its landing) into a folder.
void write_saltation_tables(const SaltationRun& run, const std::string& folder);
/// Writes gusts.csv.
void write_gusts(const GustRun& gusts, const std::string& folder);
/// Writes the figures of one wind as a YAML file.
void write_state(const SolvedWind& wind, const std::string& path);
/// Writes summary.yaml.
void write_saltation_summary(const SaltationRun& run, const std::optional<GustRun>& gusts,
                             const std::string& folder);

}  // namespace aeolian
