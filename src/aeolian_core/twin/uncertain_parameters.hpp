#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace aeolian {

/// What a forecast rests on and nobody knows exactly, each as a factor on what is given (1: as given).
struct UncertainParameters {
  double friction_velocity = 1;  ///< on every sample of the wind
  double reptation_length = 1;   ///< on the mean
  double impact_angle = 1;       ///< on the mean
  double repose_angle = 1;       ///< on that of the grain
  double sand_supply = 1;        ///< on what comes over open borders from upwind

  static constexpr std::size_t count = 5;
  static const std::array<std::string, count>& names();
  std::array<double, count> values() const;
  static UncertainParameters from(const std::array<double, count>& values);
};

/// How well one of them is known: a log-normal distribution between bounds.
struct ParameterPrior {
  double median = 1;
  double sigma = 0;  ///< of the logarithm; 0: exactly known
  double low = 0.25;
  double high = 4;
};

using ParameterPriors = std::array<ParameterPrior, UncertainParameters::count>;

/// What is known before anything is learned: 10 % in friction velocity, and what papers disagree by in the
/// others.
ParameterPriors default_priors();

/// Independent draws from the priors, by counter: member i is the same whatever the number of members.
/// Their logarithms are not centred. Throws Error naming a prior that is not physical.
std::vector<UncertainParameters> draw_parameters(const ParameterPriors& priors, std::size_t members,
                                                 std::uint64_t seed);

}  // namespace aeolian
