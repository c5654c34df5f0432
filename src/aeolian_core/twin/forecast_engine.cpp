#include "aeolian_core/twin/forecast_engine.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"forecaster"};

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
  positive(settings.learning_horizon, "learning horizon");
  positive(settings.learning_tolerance, "learning tolerance");
  require(!settings.learner || settings.learner->members >= 2, "number of members",
          settings.learner ? static_cast<double>(settings.learner->members) : 0, "two or more");
}

std::size_t nearest(const std::vector<double>& values, double wanted) {
  const auto at = std::min_element(values.begin(), values.end(), [wanted](double a, double b) {
    return std::abs(a - wanted) < std::abs(b - wanted);
  });
  return static_cast<std::size_t>(at - values.begin());
}

const ForecastEngine::Settings& checked(const ForecastEngine::Settings& settings) {
  check(settings);
  return settings;
}

}  // namespace

ForecastEngine::ForecastEngine(const Settings& settings)
    : settings_(checked(settings)),
      learning_horizon_(nearest(settings.horizons, settings.learning_horizon)),
      ensemble_(settings.physics, settings.ensemble),
      wind_(settings.wind) {
  settings_.physics.saltation.check(settings_.physics.grain);
  if (settings_.learner) learner_.emplace(*settings_.learner);
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
  kept_.reset();
  last_forecast_.reset();
  forecast_before_.reset();
  taught_until_.reset();
}

bool ForecastEngine::is_due(double time) const {
  return !last_forecast_ || seconds_between(*last_forecast_, time) >= settings_.period;
}

/// From the forecast that holds for this map, if there is one.
std::optional<ParameterLearner::Update> ForecastEngine::learn(const HeightMap& map, double time) {
  if (!kept_) return std::nullopt;
  const double due = kept_->time + settings_.horizons[learning_horizon_];
  const double late = seconds_between(due, time);
  if (late < 0) return std::nullopt;
  const Kept kept = std::move(*kept_);
  kept_.reset();
  if (late > settings_.learning_tolerance) {
    ParameterLearner::Update update;
    update.why_not = "no map came in the " + std::to_string(settings_.learning_tolerance) +
                     " s after the time of the forecast";
    update.before = update.after = learner_->median();
    return update;
  }
  taught_until_ = time;
  return learner_->learn(kept.forecast, learning_horizon_, map);
}

ForecastJob ForecastEngine::make_job(const HeightMap& map, double time, std::vector<WindSpell> wind) const {
  ForecastJob job;
  job.time = time;
  job.wind = std::move(wind);
  job.start = HeightMap(map.geometry());
  for (const auto& name : {layer::elevation, layer::ground, layer::variance})
    if (map.has(name)) job.start.add(name, map.layer(name));
  if (learner_) {
    job.members = learner_->members();
    job.median = learner_->median();
  }
  return job;
}

ForecastEngine::Taken ForecastEngine::take_map(const HeightMap& map, double time) {
  require(std::isfinite(time), "time of a map", time, "finite");
  if (last_map_ && time < *last_map_) begin_anew();
  last_map_ = time;

  Taken taken;
  if (auto update = learn(map, time)) taken.learned.push_back(std::move(*update));
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

void ForecastEngine::defer(const ForecastJob& job) {
  if (last_forecast_ == job.time) last_forecast_ = forecast_before_;
}

void ForecastEngine::begin(const ForecastJob& job) {
  if (!last_map_ || job.time > *last_map_) return;  // the engine has begun anew
  forecast_before_ = last_forecast_;
  last_forecast_ = job.time;
}

EnsembleForecast ForecastEngine::run(const ForecastJob& job) const {
  return ensemble_.run(job.start, job.wind, settings_.horizons, job.members, job.median);
}

void ForecastEngine::keep(const ForecastJob& job, EnsembleForecast forecast) {
  if (!learner_ || !settings_.learning || !last_map_ || forecast.members.empty()) return;
  const bool from_before = job.time > *last_map_;  // the engine began anew
  const bool overlaps = kept_ || (taught_until_ && seconds_between(*taught_until_, job.time) < 0);
  const double due = job.time + settings_.horizons[learning_horizon_];
  const bool is_over = seconds_between(due, *last_map_) > 0;
  if (from_before || overlaps || is_over) return;
  kept_ = Kept{job.time, std::move(forecast)};
}

}  // namespace aeolian
