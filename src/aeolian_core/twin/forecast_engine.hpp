#pragma once

#include <deque>
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
///     if (taken.job) publish(engine.run(*taken.job));
///
/// It learns from hindcasts: when a map comes, members go to it from an earlier one in the wind that blew, so
/// that what they miss by is the parameters', not the weather's.
///
/// A lesson waits, up to three times its period, until the bed has moved beyond the noise of the maps: two
/// standard deviations of a cell on squares of 8 mm, RMS in the hindcast or half of the squares in the maps.
/// As long as a live map cannot tell that the bed moves it takes it to be at rest and averages: it then lags
/// by up to 18 s and loses up to 7 % of the ripples, which looks like ripples that hardly grow. And as long
/// as the hindcast hardly moves, for too low a friction velocity was learned, it is the maps that tell
/// better.
///
/// What was learned over a minute moves forecasts only once it has proved itself over the time of a forecast:
/// with each lesson, hindcasts with the learned and with the given parameters go to the newest map from the
/// oldest one that is not farther back than the longest horizon (nor than the wind is remembered), but half
/// as far at least. Whichever comes nearer, beyond doubt (two standard errors), is believed from then on.
class ForecastEngine {
 public:
  struct Settings {
    TwinPhysics physics;
    ForecastEnsemble::Settings ensemble;
    WindCourse::Settings wind;
    std::optional<ParameterLearner::Settings> learner;  ///< nothing: one forecast with the given parameters
    bool learning = true;                               ///< misses are looked at; needs a learner
    /// From one map learned from to the next, at least [s], and from one attempt to the next. A map that
    /// comes after more than three times as long teaches nothing: too much has happened.
    double learning_period = 60;
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
    std::optional<ForecastJob> job;                   ///< when a forecast is due and there is wind
    std::optional<ParameterLearner::Update> learned;  ///< from a hindcast of this map
    std::optional<double> bridged_gap;                ///< in the wind of the job [s]
    /// Of the longest horizon, how much the wind that was once given ahead does not reach: bridged [s].
    std::optional<double> not_given_ahead;
    bool without_wind = false;  ///< due, but no wind is known
  };
  /// Maps come in the order of their times; one that is older begins the engine anew but for what it has
  /// learned.
  Taken take_map(const HeightMap& map, double time);

  /// The job of the map of that time [s] has to wait: the next map is due as well and may take its place.
  /// begin() when it is run after all.
  void defer(double job_time);
  void begin(double job_time);

  /// May run in another thread while maps and wind are taken.
  EnsembleForecast run(const ForecastJob& job) const;

  ParameterLearner* learner() { return learner_ ? &*learner_ : nullptr; }
  /// Whether forecasts are made with what was learned rather than with what was given. What was loaded into
  /// the learner before the first map is believed until it is refuted.
  bool believes() const { return believes_; }
  const Settings& settings() const { return settings_; }

 private:
  /// The map from which the next hindcast starts: elevation and ground.
  struct Lesson {
    double time;
    HeightMap start;
    double variance;  ///< of its elevation, mean over the map [m^2]
    double tried;     ///< when the last map was looked at [s]
  };

  void begin_anew();
  bool is_due(double time) const;
  std::optional<ParameterLearner::Update> learn(const HeightMap& map, double time);
  /// Nothing while the bed has not moved beyond the noise and there is time left.
  std::optional<ParameterLearner::Update> learn(const Lesson& lesson, const HeightMap& map, double period);
  std::vector<WindSpell> known_wind(double from, double duration) const;
  void judge(const HeightMap& map, double time);
  void keep_start(const Lesson& lesson);
  ForecastJob make_job(const HeightMap& map, double time, std::vector<WindSpell> wind) const;

  Settings settings_;
  ForecastEnsemble ensemble_;
  ForecastEnsemble hindcasts_;  ///< members differ in their parameters only
  WindCourse wind_;
  std::optional<ParameterLearner> learner_;
  std::vector<UncertainParameters> given_;  ///< the learner's members before anything is learned
  UncertainParameters given_median_;
  bool believes_ = false;
  std::optional<Lesson> lesson_;
  std::deque<Lesson> starts_;  ///< of hindcasts over the time of a forecast, oldest first
  std::optional<double> last_map_;
  std::optional<double> last_forecast_, forecast_before_;
};

}  // namespace aeolian
