#pragma once

#include <cstdint>
#include <vector>

#include "learning_day.hpp"

#include "aeolian_core/twin/forecast_ensemble.hpp"
#include "aeolian_core/twin/parameter_learner.hpp"

namespace aeolian {

/// A twin that sees a day through noise and an anemometer that is wrong by a factor.
class LearningTwin {
 public:
  struct Settings {
    double wind_factor = 1;     ///< of the anemometer
    double map_error = 0.0002;  ///< standard deviation of a cell's elevation, independent [m]
    std::uint64_t seed = 1;     ///< of that error
    bool wind_ahead = true;     ///< forecasts know the wind to come; else the last five minutes' goes on
    Border border = Border::periodic;
    ParameterLearner::Settings learner;
  };

  LearningTwin(const LearningDay& day, const Settings& settings);

  /// The surface as measured, with the layer `variance`.
  HeightMap measured(double time) const;
  std::vector<WindSpell> wind_that_blew(double from, double duration) const;

  /// Learns from `from` to `until` [s]: when a map comes, the members go from the last one to it with the
  /// wind that blew, and differ in their parameters only. A map every `period` [s].
  void learn_from_hindcasts(double from, double until, double period);
  /// The same from forecasts: members differ in map and wind as well, and the wind to come is not known.
  void learn_from_forecasts(double from, double until, double period);

  ParameterLearner& learner() { return learner_; }
  const ParameterLearner::Update& last() const { return last_; }

  /// What a bed does with these parameters: the surface after `lead` [s].
  HeightMap::Layer forecast(double time, double lead, const UncertainParameters& parameters) const;

 private:
  std::vector<WindSpell> wind_so_far(double time, double lead, double window) const;
  void learn(const ForecastEnsemble& ensemble, const HeightMap& start, const std::vector<WindSpell>& wind,
             double time, double period);

  const LearningDay& day_;
  Settings settings_;
  std::vector<WindSample> given_;
  TwinPhysics physics_;
  ParameterLearner learner_;
  ParameterLearner::Update last_;
};

}  // namespace aeolian
