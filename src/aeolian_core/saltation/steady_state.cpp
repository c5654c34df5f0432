#include "aeolian_core/saltation/steady_state.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
double SaltatingBed::roughness_length() const {
  return roughness > 0 ? roughness : grain_roughness(grain.diameter);
}

double SaltatingBed::fluid_threshold() const {
  return 0.1 * std::sqrt((grain.density / atmosphere.density - 1) * atmosphere.gravity * grain.diameter);
}

void check(const SaltatingBed& bed) {
  check(bed.grain);
  check(bed.atmosphere);
  if (!(bed.roughness >= 0 && bed.roughness <= 1))
    throw Error("saltating bed: roughness is " + std::to_string(bed.roughness) + " m, must be 0 to 1 m");
  if (!(bed.atmosphere.density < bed.grain.density))
    throw Error("saltating bed: the air's density is " + std::to_string(bed.atmosphere.density) +
                " kg/m^3, must be below the grain's");
}

double SteadyState::impact_rate() const {
  return std::accumulate(launches.number.begin(), launches.number.end(), 0.0);
}

double SteadyState::mass_flux() const {
  return grain_mass *
         std::inner_product(launches.number.begin(), launches.number.end(), landings.length.begin(), 0.0);
}

double SteadyState::mean(const std::vector<double>& column) const {
  const double rate = impact_rate();
  return rate > 0
             ? std::inner_product(launches.number.begin(), launches.number.end(), column.begin(), 0.0) / rate
             : 0;
}

double SteadyState::spread(const std::vector<double>& column) const {
  const double centre = mean(column);
  std::vector<double> squares(column);
  for (double& v : squares) v = (v - centre) * (v - centre);
  return std::sqrt(mean(squares));
}

}  // namespace aeolian
