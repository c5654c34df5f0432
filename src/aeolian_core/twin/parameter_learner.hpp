#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "aeolian_core/twin/forecast_ensemble.hpp"
#include "aeolian_core/twin/uncertain_parameters.hpp"

namespace aeolian {

/// What the twin has learned of its parameters from misses.
struct LearnedState {
  std::vector<UncertainParameters> members;
  std::size_t updates = 0;  ///< forecasts learned from
};

/// Learns the parameters of forecasts from what was measured when their time came: an ensemble Kalman update
/// over the logarithms of the parameters (parameter_update.hpp), with localisation, bounds and inflation.
///
///     ParameterLearner learner(settings);
///     const EnsembleForecast forecast = ensemble.run(map, wind, {60}, learner.members(), learner.median());
///     learner.learn(forecast, 0, map_60_s_later);
class ParameterLearner {
 public:
  struct Settings {
    ParameterPriors priors = default_priors();
    std::size_t members = 20;
    std::uint64_t seed = 1;
    bool frozen = false;  ///< misses are watched and nothing is learned
    double cell = 0.004;  ///< misses are averaged over cells of up to so much [m]
    double block = 0.05;  ///< errors of the model are alike within squares of this side, counted as one [m]
    /// Inflation: no parameter is ever known better than this share of its prior's sigma. The best parameters
    /// drift while ripples grow, as no model is perfect; who is too sure cannot follow.
    double least_spread = 0.4;
  };

  /// The members' logarithms have exactly the mean and spread of the priors, and no correlation. Throws Error
  /// naming a setting outside its range.
  explicit ParameterLearner(const Settings& settings);

  const std::vector<UncertainParameters>& members() const { return state_.members; }
  /// The geometric mean of the members.
  UncertainParameters median() const;
  const LearnedState& state() const { return state_; }

  void freeze(bool frozen) { settings_.frozen = frozen; }

  /// What one update did, for people to watch.
  struct Update {
    bool learned = false;
    std::string why_not;    ///< when it did not: frozen, nothing tells of the parameters, too few cells ...
    double innovation = 0;  ///< RMS of measured - predicted, in units of what was expected
    UncertainParameters before;  ///< medians
    UncertainParameters after;
  };
  /// Compares what the members predicted for horizon number `horizon` with the surface measured then: layers
  /// elevation and, when known, variance, on any grid. A forecast by other members than those of now is not
  /// learned from, so that nothing is learned twice. Throws Error when there is no such horizon.
  Update learn(const EnsembleForecast& predicted, std::size_t horizon, const HeightMap& measured);

  /// YAML with version, number of updates and members; written beside and renamed.
  void save(const std::string& path) const;
  /// Throws Error naming file, line and value for one that is not physical, and leaves what is known as it
  /// was.
  void load(const std::string& path);

 private:
  Settings settings_;
  LearnedState state_;
};

}  // namespace aeolian
