#pragma once

#include <optional>
#include <string>

#include "aeolian_twin/saltation/saltation_files.hpp"

namespace aeolian {

/// In what a place differs from level, loose sand without end.
struct SiteConditions {
  double slope = 0;                ///< of the bed, positive where it rises downwind [rad]
  std::optional<double> cohesion;  ///< [N/m]; none: Bagnold's fluid threshold
  std::optional<double> fetch;     ///< of sand upwind [m]; none: without end
};

/// What becomes of a wind's flux at a place.
struct SiteRun {
  SiteConditions conditions;
  double impact_threshold = 0;  ///< [m/s]
  double fluid_threshold = 0;   ///< [m/s]
  bool starts = false;          ///< whether the wind sets grains moving without any from upwind
  double saturated_flux = 0;    ///< that comes about in the end [kg m^-1 s^-1]
  double flux = 0;              ///< at the fetch [kg m^-1 s^-1]
};

/// From the run's flux law, with the thresholds of the place. Throws Error for a slope that is not gentler
/// than the angle of repose, and where the run has no law.
SiteRun at_site(const SaltationRun& run, const SiteConditions& conditions);

/// Writes site.yaml.
void write_site(const SiteRun& run, const std::string& folder);

/// The asked wind over ground that gives no grains of its own, when this flux [kg m^-1 s^-1] comes from
/// upwind.
SolvedWind over_hard_ground(const SaltatingBed& bed, double friction_velocity, double flux);

}  // namespace aeolian
