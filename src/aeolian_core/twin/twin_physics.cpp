#include "aeolian_core/twin/twin_physics.hpp"

#include <algorithm>

namespace aeolian {
namespace {

// What a check of forcings and grains allows [rad].
constexpr double least_impact_angle = 0.02;
constexpr double greatest_impact_angle = 1.4;
constexpr double least_repose = 0.1;
constexpr double greatest_repose = 1.4;

}  // namespace

Forcing forcing_of(const TwinPhysics& physics, const WindSpell& spell,
                   const UncertainParameters& parameters) {
  std::vector<Forcing> forcings;
  forcings.reserve(spell.samples.size());
  for (const WindSample& wind : spell.samples) {
    const SaltationState state = physics.saltation.state(
        wind.friction_velocity * parameters.friction_velocity, physics.grain, wind.air_density);
    forcings.push_back(make_forcing(state, wind.direction, physics.grain, physics.splash));
  }
  Forcing mean = mean_forcing(forcings, spell.weights);
  mean.reptation_length *= parameters.reptation_length;
  mean.impact_angle =
      std::clamp(mean.impact_angle * parameters.impact_angle, least_impact_angle, greatest_impact_angle);
  mean.grain.angle_of_repose =
      std::clamp(mean.grain.angle_of_repose * parameters.repose_angle, least_repose, greatest_repose);
  return mean;
}

RippleParameters ripple_parameters(const TwinPhysics& physics, const UncertainParameters& parameters) {
  RippleParameters ripple = physics.ripple;
  ripple.supply *= parameters.sand_supply;
  return ripple;
}

}  // namespace aeolian
