#include "aeolian_core/saltation/saltation_source.hpp"

#include <cmath>
#include <sstream>
#include <string>

#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"saltation table"};
constexpr double widest = 0.25;  ///< of the ratio of densities from the table's, relative

std::string range(double low, double high) {
  std::ostringstream text;
  text << low << " to " << high;
  return text.str();
}

}  // namespace

void SaltationSource::check(const Grain& grain, double air_density) const {
  aeolian::check(grain);
  if (!table_) return;
  if (!(grain.diameter >= table_->least_diameter() && grain.diameter <= table_->largest_diameter()))
    require.refuse("the grain's diameter", grain.diameter,
                   range(table_->least_diameter(), table_->largest_diameter()) + " m");
  const double solved = table_->grain_density() / table_->air_density();
  const double ratio = grain.density / air_density;
  if (!(std::abs(ratio / solved - 1) <= widest))
    require.refuse("density of the grain over that of the air", ratio,
                   range((1 - widest) * solved, (1 + widest) * solved));
}

SaltationState SaltationSource::state(double friction_velocity, const Grain& grain,
                                      double air_density) const {
  if (!table_) return steady_saltation(friction_velocity, grain, air_density);
  check(grain, air_density);
  const double lightness = table_->grain_density() / table_->air_density() / (grain.density / air_density);
  const double scale = std::pow(lightness, 0.15);  // of friction velocities, the table's over these
  SaltationState state = table_->state(friction_velocity * scale, grain.diameter);
  state.friction_velocity = friction_velocity;
  state.impact_threshold /= scale;
  state.surface_friction_velocity /= scale;
  // Q goes with air density times the third power of friction velocities, the impact rate with Q over the
  // mass.
  state.mass_flux *= air_density / table_->air_density() / (scale * scale * scale);
  state.impact_rate = state.mass_flux / (grain.mass() * state.hop_length);
  return state;
}

}  // namespace aeolian
