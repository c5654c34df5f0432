#include <algorithm>
#include <cmath>

#include "aeolian_core/saltation/approach.hpp"
#include "aeolian_core/saltation/steady_state.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using Outcome = SteadyState::Outcome;

constexpr double pinned = 0.9999;  ///< surface over free wind: no room for grains
constexpr double calm = 1e-3;      ///< surface over free wind: nothing left for grains to take
constexpr int thin_steps = 3;      ///< of a few grains that find the form of their spectrum
constexpr double strongest = 10;   ///< [m/s]

const char* const too_many =
    "more than one grain leaves for each that lands, however slow the wind at the bed is";
const char* const too_fast = "grains leave the bed ever faster: the splash function gives more than it gets";
const char* const too_few = "less than one grain leaves for each that lands";
const char* const restless = "numbers of grains and wind do not settle";

/// A few grains in the wind of a surface friction velocity that just keeps them up, found on the way.
/// Returns that velocity.
double thin_step(Approach& approach, double wind) {
  approach.set_winds(wind, wind);
  approach.step();
  approach.accept();
  return wind * std::exp(-std::clamp(0.5 * std::log(approach.replacement()), -0.3, 0.3));
}

SteadyState outcome(const Approach& approach, Outcome outcome, const std::string& reason = "") {
  SteadyState state = approach.state();
  state.outcome = outcome;
  state.reason = reason;
  if (outcome == Outcome::steady) return state;
  state.surface_friction_velocity = state.friction_velocity;
  state.wind.set_logarithmic(state.friction_velocity);
  for (auto* column : {&state.launches.number, &state.grain_stress, &state.landings.vx, &state.landings.vy,
                       &state.landings.duration, &state.landings.length, &state.landings.apex})
    std::fill(column->begin(), column->end(), 0.0);
  return state;
}

/// Spectrum and grains for one wind at the surface, without haste. Whether they settle or the sign of
/// ln(replacement) is clear.
void relax(Approach& approach, double tolerance) {
  for (int n = 0; n < 40; ++n) {
    approach.step();
    approach.accept();
    const double change = approach.spectrum_change();
    if (change < tolerance || 10 * change < std::abs(std::log(approach.replacement()))) return;
  }
}

/// Whether the grains of the last step, in the free wind down to the bed, are too few to keep up their
/// number.
bool dies_out(const Approach& approach, double tolerance) {
  const double replacement = approach.replacement();
  return replacement < 1 && !approach.was_extended() &&
         (replacement < 0.5 || approach.spectrum_change() < std::max(tolerance, 1 - replacement));
}

}  // namespace

SaltationSolver::SaltationSolver(const SaltatingBed& bed, const SplashKernel& splash,
                                 const SolverSettings& settings)
    : SaltationSolver((check(bed), bed),
                      FlyingGrains(Drag(bed.drag_law, bed.grain, bed.atmosphere, bed.drag_scale)), splash,
                      settings) {}

SaltationSolver::SaltationSolver(const SaltatingBed& bed, const FlyingGrains& grains,
                                 const SplashKernel& splash, const SolverSettings& settings)
    : bed_((check(bed), bed)), splash_(splash.clone()), settings_(settings), grains_(grains) {}

SteadyState SaltationSolver::approach_from(double free, const SteadyState* begin) const {
  Approach approach(bed_, *splash_, grains_, settings_.flight_tolerance);
  const double most = pinned * free;
  double surface = 0.8 * bed_.fluid_threshold();
  if (begin) {
    approach.begin_at(*begin, free);
    surface = approach.surface();
  } else {
    for (int n = 0; n < thin_steps; ++n) surface = thin_step(approach, surface);
  }
  approach.set_winds(free, std::min(surface, most));
  // In too weak a wind there is nothing to mix: a few grains are followed until they are seen to die out.
  for (int n = 0; n < 40 && surface >= most; ++n) {
    approach.step();
    if (!approach.extend_if_cut_off()) return outcome(approach, Outcome::none, too_fast);
    if (dies_out(approach, settings_.tolerance)) return outcome(approach, Outcome::below_threshold, too_few);
    approach.accept();
    if (approach.replacement() > 1) break;
  }

  for (int n = 0; n < settings_.most_iterations; ++n) {
    approach.step();
    if (!approach.extend_if_cut_off()) return outcome(approach, Outcome::none, too_fast);
    if (approach.settled(settings_.tolerance)) return outcome(approach, Outcome::steady);
    if (approach.surface() >= most && dies_out(approach, settings_.tolerance))
      return outcome(approach, Outcome::below_threshold, too_few);
    if (approach.surface() < calm * free) return outcome(approach, Outcome::none, too_many);
    approach.mix(most);
  }
  return outcome(approach, Outcome::none, restless);
}

SteadyState SaltationSolver::rise_to(double free, double threshold) const {
  double wind = 1.1 * threshold;
  SteadyState state = approach_from(wind, nullptr);
  double growth = 1.3;
  while (state.steady() && wind < free && growth > 1.02) {
    const double next = std::min(free, growth * wind);
    SteadyState stronger = approach_from(next, &state);
    if (stronger.steady()) {
      wind = next;
      state = std::move(stronger);
    } else {
      growth = std::sqrt(growth);
    }
  }
  return state;
}

SteadyState SaltationSolver::solve(double free, const SteadyState* begin) const {
  if (!(free >= 0 && free <= strongest))
    throw Error("saltation: friction velocity is " + std::to_string(free) + " m/s, must be 0 to " +
                std::to_string(strongest));
  if (free < 0.05 * bed_.fluid_threshold() && !begin) {
    SteadyState still{WindProfile(bed_.roughness_length())};
    still.friction_velocity = still.surface_friction_velocity = free;
    still.wind.set_logarithmic(free);
    still.grain_stress.assign(WindProfile::levels, 0);
    still.spectrum = splash_->first_spectrum();
    still.grain_mass = bed_.grain.mass();
    still.reason = too_few;
    return still;
  }
  if (begin && begin->steady()) {
    SteadyState state = approach_from(free, begin);
    if (state.outcome != Outcome::none) return state;
  }
  SteadyState state = approach_from(free, nullptr);
  if (state.outcome != Outcome::none) return state;
  std::string why;
  const std::optional<double> threshold = impact_threshold(&why);
  if (!threshold) {
    state.reason = why;
    return state;
  }
  if (free > 1.1 * *threshold) {
    SteadyState risen = rise_to(free, *threshold);
    if (risen.steady() && risen.friction_velocity == free) return risen;
  }
  return bisect(free);
}

SteadyState SaltationSolver::bisect(double free) const {
  Approach approach(bed_, *splash_, grains_, settings_.flight_tolerance);
  const double tolerance = settings_.tolerance;
  double low = calm * free;
  double high = pinned * free;
  for (int halving = 0; halving < 20 && high / low > 1 + 0.1 * tolerance; ++halving) {
    const double middle = std::sqrt(low * high);
    approach.set_winds(free, middle);
    relax(approach, tolerance);
    if (!approach.extend_if_cut_off()) return outcome(approach, Outcome::none, too_fast);
    (approach.replacement() > 1 ? high : low) = middle;
  }
  if (low == calm * free) return outcome(approach, Outcome::none, too_many);
  return approach.settled(10 * tolerance) ? outcome(approach, Outcome::steady)
                                          : outcome(approach, Outcome::none, restless);
}

std::optional<double> SaltationSolver::impact_threshold(std::string* why) const {
  const auto none = [&](const char* reason) {
    if (why) *why = reason;
    return std::nullopt;
  };
  Approach approach(bed_, *splash_, grains_, settings_.flight_tolerance);
  double wind = 0.8 * bed_.fluid_threshold();
  for (int n = 0; n < 200; ++n) {
    const double next = thin_step(approach, wind);
    if (!approach.extend_if_cut_off()) return none(too_fast);
    if (approach.settled(settings_.tolerance)) return next;
    wind = next;
    if (wind > strongest) return none(too_few);
    if (wind < calm * bed_.fluid_threshold()) return none(too_many);
  }
  return none(restless);
}

}  // namespace aeolian
