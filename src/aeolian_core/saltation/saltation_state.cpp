#include "aeolian_core/saltation/saltation_state.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double solved_air_density = 1.225;   ///< [kg/m^3]
constexpr double solved_grain_density = 2650;  ///< [kg/m^3]

/// Numbers that sum up the solved states of one grain size. The means of impacts are those at u* = 0.4 m/s.
struct SolvedGrain {
  double diameter;      ///< [m]
  double threshold;     ///< u*_it [m/s]
  double amplitude;     ///< A [kg s m^-3]
  double correction;    ///< B
  double impact_speed;  ///< [m/s]
  double impact_angle;  ///< [rad]
  double hop_length;    ///< [m]
};

constexpr SolvedGrain fine{0.00025, 0.209, 0.242, 0.08, 1.39, 14.1 * degree, 0.148};
constexpr SolvedGrain coarse{0.00040, 0.270, 0.2995, 0.1365, 1.65, 15.5 * degree, 0.210};

/// Relative change of the means of impacts per m/s of friction velocity about 0.4 m/s, from the states of
/// 0.25 mm at u* of 0.22 to 0.7 m/s.
constexpr double speed_trend = 0.09;
constexpr double angle_trend = 0.22;
constexpr double hop_trend = 0.59;

SolvedGrain interpolate(double diameter) {
  const SolvedGrain& nearest = diameter < fine.diameter ? fine : coarse;
  if (diameter < fine.diameter || diameter > coarse.diameter) {
    const double ratio = diameter / nearest.diameter;
    SolvedGrain scaled = nearest;
    scaled.threshold *= std::sqrt(ratio);
    scaled.amplitude *= std::sqrt(ratio);
    scaled.impact_speed *= std::sqrt(ratio);
    scaled.hop_length *= ratio;
    return scaled;
  }
  const double w = (diameter - fine.diameter) / (coarse.diameter - fine.diameter);
  const auto mix = [w](double a, double b) { return a + w * (b - a); };
  return {diameter,
          mix(fine.threshold, coarse.threshold),
          mix(fine.amplitude, coarse.amplitude),
          mix(fine.correction, coarse.correction),
          mix(fine.impact_speed, coarse.impact_speed),
          mix(fine.impact_angle, coarse.impact_angle),
          mix(fine.hop_length, coarse.hop_length)};
}

}  // namespace

SaltationState steady_saltation(double friction_velocity, const Grain& grain, double air_density) {
  if (!(friction_velocity >= 0) || !std::isfinite(friction_velocity))
    throw Error("saltation: friction velocity is " + std::to_string(friction_velocity) +
                " m/s, must be zero or more and finite");
  if (!(air_density > 0.1 && air_density < 100))
    throw Error("saltation: air density is " + std::to_string(air_density) + " kg/m^3, must be 0.1 to 100");
  check(grain);

  const SolvedGrain solved = interpolate(grain.diameter);
  const double density_ratio = air_density / solved_air_density;
  const double lightness = std::sqrt(grain.density / solved_grain_density / density_ratio);

  SaltationState state;
  state.friction_velocity = friction_velocity;
  state.impact_threshold = solved.threshold * lightness;
  const double above = std::max(friction_velocity, state.impact_threshold) - 0.4;
  state.impact_speed = solved.impact_speed * (1 + speed_trend * above);
  state.impact_angle = solved.impact_angle * (1 + angle_trend * above);
  state.hop_length = solved.hop_length * (1 + hop_trend * above);
  if (friction_velocity <= state.impact_threshold) return state;

  const double it = state.impact_threshold;
  state.mass_flux = solved.amplitude * density_ratio * lightness *
                    (friction_velocity * friction_velocity - it * it) *
                    (1 + solved.correction * (friction_velocity / it - 1));
  state.impact_rate = state.mass_flux / (grain.mass() * state.hop_length);
  return state;
}

}  // namespace aeolian
