#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/saltation/flying_grains.hpp"
#include "aeolian_core/saltation/splash_kernel.hpp"

namespace aeolian {

struct Past;

/// Grains in air over a flat bed of them.
struct SaltatingBed {
  Grain grain;
  Atmosphere atmosphere;
  DragLaw drag_law = DragLaw::sand;
  double drag_scale = 1;  ///< 0.62: agrees with the figures printed in Werner (1987)
  double roughness = 0;   ///< [m]; zero: a thirtieth of the grain's diameter

  double roughness_length() const;  ///< [m]
  /// u*_ft = 0.1 sqrt((rho_s / rho - 1) g d), where wind alone sets loose grains moving (Bagnold 1941).
  double fluid_threshold() const;
};

/// Throws Error naming the property, its value and what is allowed.
void check(const SaltatingBed& bed);

/// Saltation that reproduces itself: each grain that lands is replaced by one that leaves.
struct SteadyState {
  enum class Outcome {
    steady,
    below_threshold,  ///< grains die out in this wind
    none,             ///< they neither die out nor come to a balance
  };
  explicit SteadyState(WindProfile w) : wind(std::move(w)) {}

  Outcome outcome = Outcome::below_threshold;
  std::string reason;  ///< why grains do not saltate steadily

  double friction_velocity = 0;          ///< u* of the free wind [m/s]
  double surface_friction_velocity = 0;  ///< u*_eff at the bed [m/s]
  WindProfile wind;
  Launches launches;                 ///< number: per area and time [m^-2 s^-1]
  Landings landings;                 ///< of classes that are launched, zero for others
  std::vector<double> grain_stress;  ///< that the grains carry at the wind's levels [Pa]
  std::vector<double> spectrum;      ///< of one grain, the splash kernel's
  double grain_mass = 0;             ///< [kg]
  std::shared_ptr<const Past> past;  ///< what the way here has told about the next state

  int iterations = 0;
  double replacement = 0;      ///< grains that leave for one that lands
  double spectrum_change = 0;  ///< in the last iteration, relative, of parts above 1e-3 of the largest
  double wind_change = 0;      ///< in the last iteration, relative

  bool steady() const { return outcome == Outcome::steady; }
  double impact_rate() const;  ///< [m^-2 s^-1]
  double mass_flux() const;    ///< over all heights, from hop lengths [kg m^-1 s^-1]
  /// Mean over grains of what a column of `landings` or `launches` says.
  double mean(const std::vector<double>& column) const;
  double spread(const std::vector<double>& column) const;  ///< standard deviation
};

struct SolverSettings {
  double tolerance = 1e-3;         ///< of replacement, spectrum and wind
  double flight_tolerance = 1e-4;  ///< see FlightConditions
  int most_iterations = 60;        ///< then slower, surer ways: from weaker winds, by bisection
};

/// The fixed point of Werner (1987), ch. IV, found with the friction velocity at the surface as the unknown;
/// the number of grains follows from the momentum that the wind has to spare (saltation specification, sec.
/// 3.2).
///
///     SaltationSolver solver(bed, DistributionKernel(DistributionSplash::thesis_case(1)));
///     SteadyState weak = solver.solve(0.4);
///     SteadyState strong = solver.solve(0.5, &weak);  // begins where weak has ended
class SaltationSolver {
 public:
  /// Throws Error for a bed that is not physical.
  SaltationSolver(const SaltatingBed& bed, const SplashKernel& splash, const SolverSettings& settings = {});
  /// Grains of several sizes that are like the bed's on the mean; states count masses in the bed's grain.
  SaltationSolver(const SaltatingBed& bed, const FlyingGrains& grains, const SplashKernel& splash,
                  const SolverSettings& settings);

  /// Throws Error for a friction velocity that is negative, not finite or above 10 m/s.
  SteadyState solve(double friction_velocity, const SteadyState* begin = nullptr) const;

  /// The impact threshold u*_it [m/s]: the wind in which a few grains just keep up their number. None with a
  /// reason in `why` where there is no such wind.
  std::optional<double> impact_threshold(std::string* why = nullptr) const;

  const SaltatingBed& bed() const { return bed_; }

 private:
  /// The usual, fast way, from a cold start or another state.
  SteadyState approach_from(double friction_velocity, const SteadyState* begin) const;
  /// Step by step from just above the threshold; the last steady state on the way.
  SteadyState rise_to(double friction_velocity, double threshold) const;
  /// By halving the interval of the surface's friction velocity.
  SteadyState bisect(double friction_velocity) const;

  SaltatingBed bed_;
  std::unique_ptr<SplashKernel> splash_;
  SolverSettings settings_;
  FlyingGrains grains_;
};

}  // namespace aeolian
