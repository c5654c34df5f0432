#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "aeolian_core/saltation/flux_law.hpp"
#include "aeolian_core/saltation/saltation_state.hpp"
#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// A solved state in a few numbers. Means are over grains.
SaltationState summary(const SteadyState& state, double impact_threshold);

/// Solved states over friction velocity and grain diameter, for one material in one air, kept in a file and
/// interpolated: linear in u* / u*_it and in ln d of what varies slowly (flux over excess stress, lengths
/// over d, speeds over sqrt(g d)).
class SaltationTable {
 public:
  using Kernels = std::function<std::unique_ptr<SplashKernel>(const SaltatingBed&)>;

  /// Solves at all diameters [m] and all ratios u* / u*_it, both ascending, and half-way between them for the
  /// error. Takes about 20 ms a state. Throws Error where there is no steady state.
  static SaltationTable build(const SaltatingBed& bed, const Kernels& kernels,
                              const std::vector<double>& diameters, const std::vector<double>& ratios);
  /// Good ones: 0.1 to 1 mm, 1.02 to 5.
  static std::vector<double> usual_diameters();
  static std::vector<double> usual_ratios();

  /// Throws Error naming file and column or row of anything that write() would not have written.
  static SaltationTable read(const std::string& path);
  /// As CSV, atomically, with the command that made it at its head.
  void write(const std::string& path, const std::string& command = "") const;

  /// The state between the solved ones; nothing moves up to the threshold. Above the largest ratio the flux
  /// goes on as the flux law and the means stay. Throws Error for a friction velocity that is negative or not
  /// finite and diameters that are not within the table.
  SaltationState state(double friction_velocity, double diameter) const;
  /// The three numbers of one diameter.
  FluxLaw law(double diameter) const;

  /// Largest relative difference of fluxes from states that were solved half-way between those of the table.
  double error() const { return error_; }
  double least_diameter() const { return diameters_.front(); }
  double largest_diameter() const { return diameters_.back(); }
  double grain_density() const { return grain_density_; }
  double air_density() const { return air_density_; }

 private:
  /// What varies slowly, without dimensions where possible.
  struct Scaled {
    double flux, surface, speed, angle, spread, length, height, time, log_roughness;
  };
  struct Place {
    std::size_t index;
    double part;
  };
  SaltationTable() = default;
  Place diameter_place(double diameter) const;
  Scaled scaled(const SaltationState& state, double diameter) const;
  void prepare();

  std::vector<double> diameters_, ratios_;
  std::vector<SaltationState> states_;  ///< all ratios of the first diameter, then of the next
  double grain_density_ = 0, air_density_ = 0, gravity_ = 0, error_ = 0;

  std::vector<double> log_diameter_, threshold_;  ///< threshold over sqrt(g d)
  std::vector<Scaled> scaled_;
  std::vector<FluxLaw> laws_;
};

}  // namespace aeolian
