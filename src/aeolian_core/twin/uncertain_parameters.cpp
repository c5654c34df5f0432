#include "aeolian_core/twin/uncertain_parameters.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr std::uint64_t stream_of_members = 0x706172616d6574;  // "paramet": like no other stream of a seed

void check(const ParameterPriors& priors) {
  constexpr Require require{"prior"};
  for (std::size_t i = 0; i < priors.size(); ++i) {
    const ParameterPrior& prior = priors[i];
    const std::string& name = UncertainParameters::names()[i];
    require(prior.low > 0 && std::isfinite(prior.low), "lower bound of " + name, prior.low,
            "positive and finite");
    require(prior.high >= prior.low && std::isfinite(prior.high), "upper bound of " + name, prior.high,
            "finite and not below the lower");
    require(prior.median >= prior.low && prior.median <= prior.high, "median of " + name, prior.median,
            "within the bounds");
    require(prior.sigma >= 0 && prior.sigma <= 2, "sigma of " + name, prior.sigma, "0 to 2");
  }
}

}  // namespace

const std::array<std::string, UncertainParameters::count>& UncertainParameters::names() {
  static const std::array<std::string, count> names{"friction_velocity", "reptation_length", "impact_angle",
                                                    "repose_angle", "sand_supply"};
  return names;
}

std::array<double, UncertainParameters::count> UncertainParameters::values() const {
  return {friction_velocity, reptation_length, impact_angle, repose_angle, sand_supply};
}

UncertainParameters UncertainParameters::from(const std::array<double, count>& values) {
  return {values[0], values[1], values[2], values[3], values[4]};
}

ParameterPriors default_priors() {
  // median, sigma, low, high. Friction velocity: a log law over an unknown roughness, an anemometer out of
  // place. Reptation: 5 to 10 mm are told of one sand. Impact angle: 9 to 15 degrees. Repose: 30 to 36.
  return {{{1, 0.10, 0.5, 2}, {1, 0.20, 0.3, 3}, {1, 0.15, 0.5, 2}, {1, 0.05, 0.7, 1.3}, {1, 0.20, 0.1, 3}}};
}

std::vector<UncertainParameters> draw_parameters(const ParameterPriors& priors, std::size_t members,
                                                 std::uint64_t seed) {
  check(priors);
  std::vector<UncertainParameters> result;
  result.reserve(members);
  for (std::size_t member = 0; member < members; ++member) {
    RandomStream random(seed, stream_of_members + member);
    std::array<double, UncertainParameters::count> values{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      const ParameterPrior& prior = priors[i];
      values[i] = std::clamp(prior.median * std::exp(prior.sigma * random.normal()), prior.low, prior.high);
    }
    result.push_back(UncertainParameters::from(values));
  }
  return result;
}

}  // namespace aeolian
