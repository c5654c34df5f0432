#include "aeolian_core/twin/forecast_engine.hpp"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/twin/bed_movement.hpp"
#include "aeolian_core/twin/forecast_contest.hpp"

namespace aeolian {
namespace {

constexpr Require require{"forecaster"};
constexpr double beyond_doubt = 2;    // standard errors
constexpr double kept_starts = 5;     // within the time of a forecast
constexpr double least_movement = 2;  // standard deviations of a cell
constexpr double longest_lesson = 3;  // learning periods

void check(const ForecastEngine::Settings& settings) {
  const auto positive = [](double value, const char* name) {
    require(value > 0 && std::isfinite(value), name, value, "positive and finite");
  };
  require(!settings.horizons.empty(), "number of horizons", 0, "one or more");
  double last = 0;
  for (const double horizon : settings.horizons) {
    require(horizon > last && std::isfinite(horizon), "a horizon", horizon,
            "finite, positive and longer than the one before");
    last = horizon;
  }
  positive(settings.period, "period");
  positive(settings.learning_period, "learning period");
}

/// Of hindcasts: the wind is known, and an error of the map would only hide what the parameters do.
ForecastEnsemble::Settings without_errors(ForecastEnsemble::Settings settings) {
  settings.wind_error = settings.direction_error = 0;
  return settings;
}

HeightMap layers_of(const HeightMap& map, std::initializer_list<std::string> names) {
  HeightMap result(map.geometry());
  for (const std::string& name : names)
    if (map.has(name)) result.add(name, map.layer(name));
  return result;
}

const ForecastEngine::Settings& checked(const ForecastEngine::Settings& settings) {
  check(settings);
  return settings;
}

}  // namespace

ForecastEngine::ForecastEngine(const Settings& settings)
    : settings_(checked(settings)),
      ensemble_(settings.physics, settings.ensemble),
      hindcasts_(settings.physics, without_errors(settings.ensemble)),
      wind_(settings.wind) {
  settings_.physics.saltation.check(settings_.physics.grain);
  if (!settings_.learner) return;
  learner_.emplace(*settings_.learner);
  given_ = learner_->members();
  given_median_ = learner_->median();
}

void ForecastEngine::take_wind(const WindSample& sample) {
  settings_.physics.saltation.check(settings_.physics.grain, sample.air_density);
  wind_.add(sample);
}

void ForecastEngine::give_wind_ahead(std::vector<WindSample> samples) {
  for (const WindSample& sample : samples)
    settings_.physics.saltation.check(settings_.physics.grain, sample.air_density);
  wind_.give_ahead(std::move(samples));
}

void ForecastEngine::begin_anew() {
  lesson_.reset();
  starts_.clear();
  last_forecast_.reset();
  forecast_before_.reset();
}

bool ForecastEngine::is_due(double time) const {
  return !last_forecast_ || seconds_between(*last_forecast_, time) >= settings_.period;
}

/// From the hindcast that ends with this map, if it is time for one.
std::optional<ParameterLearner::Update> ForecastEngine::learn(const HeightMap& map, double time) {
  if (!learner_ || !settings_.learning) return std::nullopt;
  std::optional<ParameterLearner::Update> update;
  if (lesson_) {
    if (seconds_between(lesson_->tried, time) < settings_.learning_period) return std::nullopt;
    lesson_->tried = time;
    update = learn(*lesson_, map, seconds_between(lesson_->time, time));
    if (!update) return std::nullopt;
    if (update->learned) judge(map, time);
    keep_start(*lesson_);
  }
  lesson_ = Lesson{time, layers_of(map, {layer::elevation, layer::ground}), mean_variance(map), time};
  return update;
}

std::optional<ParameterLearner::Update> ForecastEngine::learn(const Lesson& lesson, const HeightMap& map,
                                                              double period) {
  const auto nothing = [this](const std::string& why) {
    ParameterLearner::Update update;
    update.why_not = why;
    update.before = update.after = learner_->median();
    return update;
  };
  const double longest = longest_lesson * settings_.learning_period;
  if (period > longest)
    return nothing("no map came within " + std::to_string(longest) + " s of the last one learned from");
  const std::vector<WindSpell> wind = wind_.blew(lesson.time, period);
  if (wind.empty()) return nothing("the wind that blew is not known");
  for (const WindSpell& spell : wind)
    if (spell.longest_gap > settings_.wind.max_gap)
      return nothing("the wind has a gap of " + std::to_string(spell.longest_gap) + " s");
  const EnsembleForecast hindcast =
      hindcasts_.run(lesson.start, wind, {period}, learner_->members(), learner_->median());
  const double noise = std::sqrt((lesson.variance + mean_variance(map)) / 2);
  const double moved = least_movement * noise;
  const bool foreseen = rms_movement(lesson.start, hindcast.forecasts.front().map) >= moved;
  if (!foreseen && median_movement(lesson.start, map) < moved) {
    if (period + settings_.learning_period <= longest) return std::nullopt;
    return nothing("the bed has hardly moved beyond the noise of the maps");
  }
  return learner_->learn(hindcast, 0, map);
}

/// Empty when it has a gap.
std::vector<WindSpell> ForecastEngine::known_wind(double from, double duration) const {
  std::vector<WindSpell> wind = wind_.blew(from, duration);
  for (const WindSpell& spell : wind)
    if (spell.longest_gap > settings_.wind.max_gap) return {};
  return wind;
}

void ForecastEngine::keep_start(const Lesson& lesson) {
  const double apart = std::min(settings_.horizons.back(), settings_.wind.memory) / kept_starts;
  if (starts_.empty() || seconds_between(starts_.back().time, lesson.time) >= apart)
    starts_.push_back(lesson);
}

/// Of what was learned, by the longest hindcast to a map that there is.
void ForecastEngine::judge(const HeightMap& map, double time) {
  const double longest = std::min(settings_.horizons.back(), settings_.wind.memory);
  while (!starts_.empty() && seconds_between(starts_.front().time, time) > longest) starts_.pop_front();
  const Lesson& start = starts_.empty() ? *lesson_ : starts_.front();
  const double duration = seconds_between(start.time, time);
  if (duration < longest / 2) return;  // it would be judged by little else than what it was learned from
  const std::vector<WindSpell> wind = known_wind(start.time, duration);
  if (wind.empty()) return;
  const auto hindcast = [&](const UncertainParameters& parameters) {
    return hindcasts_.run(start.start, wind, {duration}, {}, parameters).forecasts.front().map;
  };
  const double found = advantage(hindcast(learner_->median()), hindcast(given_median_), map);
  if (std::abs(found) > beyond_doubt) believes_ = found > 0;
}

ForecastJob ForecastEngine::make_job(const HeightMap& map, double time, std::vector<WindSpell> wind) const {
  ForecastJob job;
  job.time = time;
  job.wind = std::move(wind);
  job.start = layers_of(map, {layer::elevation, layer::ground, layer::variance});
  if (learner_) {
    job.members = believes_ ? learner_->members() : given_;
    job.median = believes_ ? learner_->median() : given_median_;
  }
  return job;
}

ForecastEngine::Taken ForecastEngine::take_map(const HeightMap& map, double time) {
  require(std::isfinite(time), "time of a map", time, "finite");
  if (last_map_ && time < *last_map_) begin_anew();
  if (!last_map_ && learner_) believes_ = learner_->state().updates > 0;
  last_map_ = time;

  Taken taken;
  taken.learned = learn(map, time);
  if (!is_due(time)) return taken;
  std::vector<WindSpell> wind = wind_.spells(time, settings_.horizons.back());
  if (wind.empty()) {
    taken.without_wind = true;
    return taken;
  }
  double longest_gap = 0;
  for (const WindSpell& spell : wind) longest_gap = std::max(longest_gap, spell.longest_gap);
  if (longest_gap > settings_.wind.max_gap) taken.bridged_gap = longest_gap;
  if (const std::optional<double> until = wind_.ahead_until()) {
    const double missing = settings_.horizons.back() - seconds_between(time, *until);
    if (missing > 0) taken.not_given_ahead = std::min(missing, settings_.horizons.back());
  }
  taken.job = make_job(map, time, std::move(wind));
  forecast_before_ = last_forecast_;
  last_forecast_ = time;
  return taken;
}

void ForecastEngine::defer(double job_time) {
  if (last_forecast_ == job_time) last_forecast_ = forecast_before_;
}

void ForecastEngine::begin(double job_time) {
  if (!last_map_ || job_time > *last_map_) return;  // the engine has begun anew
  forecast_before_ = last_forecast_;
  last_forecast_ = job_time;
}

EnsembleForecast ForecastEngine::run(const ForecastJob& job) const {
  return ensemble_.run(job.start, job.wind, settings_.horizons, job.members, job.median);
}

}  // namespace aeolian
