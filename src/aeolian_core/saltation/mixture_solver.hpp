#pragma once

#include "aeolian_core/saltation/mixture_kernel.hpp"
#include "aeolian_core/saltation/steady_state.hpp"

namespace aeolian {

/// Grains of several sizes that saltate in one wind.
struct MixtureState {
  /// A state for each size, in the wind that all share: its launches, landings and stress are those of its
  /// own grains, so that its mass flux, impact rate and means are, too.
  std::vector<SteadyState> sizes;

  bool steady() const { return sizes.front().steady(); }
  double mass_flux() const;    ///< of all sizes [kg m^-1 s^-1]
  double impact_rate() const;  ///< of all sizes [m^-2 s^-1]
};

/// The steady state of a mixture with Kok & Renno's splash: one spectrum of launches for each size, the wind
/// slowed by the stress of all. As many grains of each size leave as land, because sizes throw up each
/// other.
class MixtureSolver {
 public:
  /// The bed's diameter gives way to the mixture's mean, which sets roughness and fluid threshold. Throws
  /// Error for a bed or a mixture that is not physical.
  MixtureSolver(const SaltatingBed& bed, const GrainMixture& mixture, const SolverSettings& settings = {},
                const KokRennoConstants& constants = {}, int speeds_per_octave = 4, int angles = 14);

  /// Throws Error for a friction velocity that is negative, not finite or above 10 m/s.
  MixtureState solve(double friction_velocity) const;
  /// See SaltationSolver.
  std::optional<double> impact_threshold(std::string* why = nullptr) const {
    return solver_.impact_threshold(why);
  }

  const GrainMixture& mixture() const { return mixture_; }
  /// A bed of grains of one size, in the roughness of all.
  SaltatingBed bed_of(std::size_t size) const;

 private:
  SaltatingBed bed_;  ///< of the mean diameter
  GrainMixture mixture_;
  SolverSettings settings_;
  SaltationSolver solver_;
};

}  // namespace aeolian
