#pragma once

#include <optional>
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
///
///     engine.take_wind(sample);
///     const ForecastEngine::Taken taken = engine.take_map(map, time);
///     if (taken.job) engine.keep(*taken.job, engine.run(*taken.job));
class ForecastEngine {
 public:
  struct Settings {
    TwinPhysics physics;
    ForecastEnsemble::Settings ensemble;
    WindCourse::Settings wind;
    std::optional<ParameterLearner::Settings> learner;  ///< nothing: one forecast with the given parameters
    bool learning = true;                               ///< misses are looked at; needs a learner
    /// Misses are those of the horizon nearest to this, of forecasts that do not overlap: each stretch of
    /// time teaches once [s].
    double learning_horizon = 60;
    double learning_tolerance = 1;  ///< the map learned from comes at most so long after its time [s]
    std::vector<double> horizons{30, 60, 120, 300};  ///< [s]
    double period = 30;                              ///< between forecasts [s]
  };

  /// Throws Error naming a setting outside its range.
  explicit ForecastEngine(const Settings& settings);

  /// Throws Error for a sample that is not physical, or whose air the saltation does not know; it is then
  /// left out.
  void take_wind(const WindSample& sample);
  void give_wind_ahead(std::vector<WindSample> samples);

  /// What a measured map leads to.
  struct Taken {
    std::optional<ForecastJob> job;                 ///< when a forecast is due and there is wind
    std::vector<ParameterLearner::Update> learned;  ///< from forecasts whose time has come
    std::optional<double> bridged_gap;              ///< in the wind of the job [s]
    /// Of the longest horizon, how much the wind that was once given ahead does not reach: bridged [s].
    std::optional<double> not_given_ahead;
    bool without_wind = false;  ///< due, but no wind is known
  };
  /// Maps come in the order of their times; one that is older begins the engine anew but for what it has
  /// learned.
  Taken take_map(const HeightMap& map, double time);

  /// A job that has to wait: the next map is due as well and may take its place. begin() when it is run after
  /// all.
  void defer(const ForecastJob& job);
  void begin(const ForecastJob& job);

  /// May run in another thread while maps and wind are taken.
  EnsembleForecast run(const ForecastJob& job) const;
  /// Hands back what a job led to, to be learned from when its time comes. A forecast that is older than the
  /// newest map by then teaches nothing.
  void keep(const ForecastJob& job, EnsembleForecast forecast);

  ParameterLearner* learner() { return learner_ ? &*learner_ : nullptr; }
  const Settings& settings() const { return settings_; }

 private:
  struct Kept {
    double time;
    EnsembleForecast forecast;
  };

  void begin_anew();
  bool is_due(double time) const;
  std::optional<ParameterLearner::Update> learn(const HeightMap& map, double time);
  ForecastJob make_job(const HeightMap& map, double time, std::vector<WindSpell> wind) const;

  Settings settings_;
  std::size_t learning_horizon_ = 0;  ///< its number
  ForecastEnsemble ensemble_;
  WindCourse wind_;
  std::optional<ParameterLearner> learner_;
  std::optional<Kept> kept_;  ///< that is learned from next
  std::optional<double> last_map_;
  std::optional<double> last_forecast_, forecast_before_;
  std::optional<double> taught_until_;  ///< time of the last map learned from
};

}  // namespace aeolian
