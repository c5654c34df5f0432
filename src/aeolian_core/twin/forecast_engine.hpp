#pragma once

#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/twin/forecast_ensemble.hpp"
#include "aeolian_core/twin/parameter_learner.hpp"
#include "aeolian_core/twin/wind_course.hpp"

namespace aeolian {

/// A map to start from, and the wind and the parameters that are to move it.
struct ForecastJob {
  double time = 0;  ///< of the map [s]
  HeightMap start;
  std::vector<WindSpell> wind;
  std::vector<UncertainParameters> members;
  UncertainParameters median;
};

/// All that the forecaster does but for messages and threads: when a forecast is due, from what, with which
/// wind, and what is learned from the misses. The node and `replay` share it.
class ForecastEngine {
 public:
  struct Settings {
    TwinPhysics physics;
    ForecastEnsemble::Settings ensemble;
    WindCourse::Settings wind;
    std::optional<ParameterLearner::Settings> learner;  ///< nothing: one forecast with the given parameters
    std::vector<double> horizons{30, 60, 120, 300};     ///< [s]
    double period = 30;                                 ///< between forecasts [s]
  };

  /// Throws Error naming a setting outside its range.
  explicit ForecastEngine(const Settings& settings);

  void take_wind(const WindSample& sample) { wind_.add(sample); }
  void give_wind_ahead(std::vector<WindSample> samples) { wind_.give_ahead(std::move(samples)); }

  /// What a measured map leads to.
  struct Taken {
    std::optional<ForecastJob> job;                 ///< when a forecast is due and there is wind
    std::vector<ParameterLearner::Update> learned;  ///< from forecasts whose time has come
    std::optional<double> bridged_gap;              ///< in the wind of the job [s]
    bool without_wind = false;                      ///< due, but no wind is known
  };
  /// Maps come in the order of their times; one that is older begins the engine anew.
  Taken take_map(const HeightMap& map, double time);

  /// May run in another thread while maps and wind are taken.
  EnsembleForecast run(const ForecastJob& job) const;
  /// Hands back what a job led to, to be learned from when its time comes.
  void keep(const ForecastJob& job, EnsembleForecast forecast);

  ParameterLearner* learner() { return learner_ ? &*learner_ : nullptr; }

 private:
  struct Kept {
    double time;
    EnsembleForecast forecast;
  };

  Settings settings_;
  ForecastEnsemble ensemble_;
  WindCourse wind_;
  std::optional<ParameterLearner> learner_;
  std::vector<Kept> kept_;
  std::optional<double> last_map_;
  std::optional<double> last_forecast_;
};

}  // namespace aeolian
