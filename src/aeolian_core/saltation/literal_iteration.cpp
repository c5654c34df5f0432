#include "aeolian_core/saltation/literal_iteration.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double flight_tolerance = 1e-4;
constexpr double negligible = 1e-7;
constexpr double calmest = 1e-3;    ///< surface over free wind
constexpr double first_rate = 1e5;  ///< grains to begin with [m^-2 s^-1]
constexpr double counted = 1e-3;

}  // namespace

SteadyState literal_iteration(const SaltatingBed& bed, const SplashKernel& splash, double free,
                              double tolerance, int most_iterations) {
  check(bed);
  if (!(free > 0 && free <= 10))
    throw Error("saltation: friction velocity is " + std::to_string(free) + " m/s, must be above 0 to 10");
  const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, bed.drag_scale);
  SteadyState state{WindProfile(bed.roughness_length())};
  state.friction_velocity = free;
  state.grain_mass = bed.grain.mass();
  state.spectrum = splash.first_spectrum();
  for (double& flux : state.spectrum) flux *= first_rate;
  state.grain_stress.assign(WindProfile::levels, 0);
  state.wind.set_logarithmic(free);
  state.surface_friction_velocity = free;
  state.outcome = SteadyState::Outcome::none;
  state.reason = "it has not settled";

  std::vector<double> stress, next, share(WindProfile::levels), before(WindProfile::levels);
  for (state.iterations = 1; state.iterations <= most_iterations; ++state.iterations) {
    const double part = std::min(0.3, 3 * std::pow(state.surface_friction_velocity / free, 2));
    const double grains = splash.number(state.spectrum);
    if (!(grains > 1e-6 * first_rate)) {
      state.outcome = SteadyState::Outcome::below_threshold;
      state.reason = "less than one grain leaves for each that lands";
      return state;
    }
    splash.launch(state.spectrum, state.launches);
    state.landings.resize(state.launches.size());
    stress.assign(WindProfile::levels, 0);
    fly(state.launches, negligible * grains, {state.wind, drag, bed.atmosphere.gravity, flight_tolerance},
        state.landings, stress);

    for (std::size_t i = 0; i < stress.size(); ++i) {
      state.grain_stress[i] += part * (state.grain_mass * stress[i] - state.grain_stress[i]);
      before[i] = state.wind.speed_at_level(i);
    }
    const double left = free * free - state.grain_stress[0] / bed.atmosphere.density;
    state.surface_friction_velocity =
        std::min(free, std::sqrt(std::max(left, calmest * calmest * free * free)));
    for (std::size_t i = 0; i < share.size(); ++i)
      share[i] = state.grain_stress[0] > 0 ? state.grain_stress[i] / state.grain_stress[0] : 0;
    state.wind.set(free, state.surface_friction_velocity, share);
    state.wind_change = 0;
    for (std::size_t i = WindProfile::levels_per_octave; i < before.size(); ++i)
      state.wind_change =
          std::max(state.wind_change, std::abs(state.wind.speed_at_level(i) / before[i] - 1) / part);

    splash.splash(state.launches, negligible * grains, state.landings, next);
    state.replacement = splash.number(next) / grains;
    const double largest = *std::max_element(next.begin(), next.end());
    state.spectrum_change = 0;
    for (std::size_t i = 0; i < next.size(); ++i) {
      if (next[i] > counted * largest)
        state.spectrum_change =
            std::max(state.spectrum_change, std::abs(next[i] - state.spectrum[i]) / next[i]);
      state.spectrum[i] += part * (next[i] - state.spectrum[i]);
    }
    if (state.spectrum_change < tolerance && state.wind_change < tolerance) {
      state.outcome = SteadyState::Outcome::steady;
      state.reason.clear();
      return state;
    }
  }
  return state;
}

}  // namespace aeolian
