#include "learning_twin.hpp"

#include "aeolian_core/surface/random.hpp"

namespace aeolian {

LearningTwin::LearningTwin(const LearningDay& day, const Settings& settings)
    : day_(day), settings_(settings), given_(day.wind), learner_(settings.learner) {
  for (WindSample& sample : given_) sample.friction_velocity *= settings.wind_factor;
  physics_.grain = learning_grain();
  physics_.ripple.border = settings.border;
}

HeightMap LearningTwin::measured(double time) const {
  HeightMap map(day_.plot);
  HeightMap::Layer& elevation = map.add(layer::elevation, day_.at(time));
  RandomStream random(settings_.seed, static_cast<std::uint64_t>(time));
  for (float& z : elevation) z += static_cast<float>(settings_.map_error * random.normal());
  map.add(layer::variance, static_cast<float>(settings_.map_error * settings_.map_error));
  return map;
}

std::vector<WindSpell> LearningTwin::wind_that_blew(double from, double duration) const {
  WindCourse course({});
  course.give_ahead(given_);
  return course.spells(from, duration);
}

std::vector<WindSpell> LearningTwin::wind_so_far(double time, double lead, double window) const {
  WindCourse::Settings settings;
  settings.window = window;
  WindCourse course(settings);
  for (const WindSample& sample : given_)
    if (sample.time <= time) course.add(sample);
  return course.spells(time, lead);
}

void LearningTwin::learn(const ForecastEnsemble& ensemble, const HeightMap& start,
                         const std::vector<WindSpell>& wind, double time, double period) {
  const EnsembleForecast predicted =
      ensemble.run(start, wind, {period}, learner_.members(), learner_.median());
  last_ = learner_.learn(predicted, 0, measured(time + period));
}

void LearningTwin::learn_from_hindcasts(double from, double until, double period) {
  ForecastEnsemble::Settings alike;
  alike.wind_error = alike.direction_error = 0;
  for (double time = from; time + period <= until; time += period) {
    HeightMap start = measured(time);
    start.remove(layer::variance);
    learn(ForecastEnsemble(physics_, alike), start, wind_that_blew(time, period), time, period);
  }
}

void LearningTwin::learn_from_forecasts(double from, double until, double period) {
  for (double time = from; time + period <= until; time += period)
    learn(ForecastEnsemble(physics_, {}), measured(time), wind_so_far(time, period, 60), time, period);
}

HeightMap::Layer LearningTwin::forecast(double time, double lead,
                                        const UncertainParameters& parameters) const {
  const auto wind = settings_.wind_ahead ? wind_that_blew(time, lead) : wind_so_far(time, lead, 300);
  const EnsembleForecast result =
      ForecastEnsemble(physics_, {}).run(measured(time), wind, {lead}, {}, parameters);
  return result.forecasts.front().map.layer(layer::elevation);
}

}  // namespace aeolian
