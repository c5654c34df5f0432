#include "aeolian_core/bedforms/erosion/drift_laws.hpp"

#include <cmath>

#include "aeolian_core/saltation/thresholds.hpp"

namespace aeolian {

double lifting_threshold(const Grain& grain, const Atmosphere& air, double gamma) {
  SaltatingBed bed;
  bed.grain = grain;
  bed.atmosphere = air;
  return cohesive_fluid_threshold(bed, M_PI / 6 * gamma);
}

double saturated_sand_flux(double friction_velocity, double threshold, const Atmosphere& air) {
  if (!(friction_velocity > threshold)) return 0;
  const double impact = 0.8 * threshold;
  return 5 * air.density / air.gravity * impact * (friction_velocity * friction_velocity - impact * impact);
}

double saturated_snow_flux(double friction_velocity, double threshold, const Atmosphere& air) {
  if (!(friction_velocity > threshold)) return 0;
  return 0.68 * air.density * threshold * (friction_velocity * friction_velocity - threshold * threshold) /
         (air.gravity * friction_velocity);
}

}  // namespace aeolian
