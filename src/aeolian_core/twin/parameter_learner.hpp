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
/// over the logarithms of the parameters (Evensen 2003, Ocean Dynamics 53, 343-367), with localisation,
/// bounds and inflation.
class ParameterLearner {
 public:
  struct Settings {
    ParameterPriors priors = default_priors();
    std::size_t members = 20;
    std::uint64_t seed = 1;
    bool frozen = false;  ///< misses are watched and nothing is learned
  };

  explicit ParameterLearner(const Settings& settings);

  const std::vector<UncertainParameters>& members() const { return state_.members; }
  UncertainParameters median() const;
  const LearnedState& state() const { return state_; }

  /// What one update did, for people to watch.
  struct Update {
    bool learned = false;
    std::string why_not;         ///< when it did not: frozen, nothing moved, too few cells ...
    double innovation = 0;       ///< RMS of measured - predicted, in units of what was expected
    UncertainParameters before;  ///< medians
    UncertainParameters after;
  };
  /// Compares what the members predicted for horizon number `horizon` with the surface measured then: layers
  /// elevation and, when known, variance, on any grid.
  Update learn(const EnsembleForecast& predicted, std::size_t horizon, const HeightMap& measured);

  /// YAML with members, number of updates and version; written beside and renamed. read() throws Error naming
  /// file, line and value for one that is not physical.
  void save(const std::string& path) const;
  void load(const std::string& path);

 private:
  Settings settings_;
  LearnedState state_;
};

}  // namespace aeolian
