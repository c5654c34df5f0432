#include <cmath>
#include <vector>

#include "learning_rows.hpp"
#include "learning_twin.hpp"
#include <tbb/parallel_for.h>

namespace aeolian {
namespace {

constexpr std::uint64_t beds = 6;
const UncertainParameters truth{1.10, 1.20, 0.88, 0.95, 1.25};

using Values = std::array<double, UncertainParameters::count>;

/// A day on which the twin's own model moved the bed of a lattice day, over open borders, with parameters
/// other than the given ones.
LearningDay model_day(const LearningDay& seen, double from) {
  TwinPhysics physics;
  physics.grain = learning_grain();
  HeightMap start(seen.plot);
  start.add(layer::elevation, seen.at(from));
  WindCourse wind({});
  wind.give_ahead(seen.wind);
  std::vector<double> times;
  for (double time = LearningDay::period; time <= 600; time += LearningDay::period) times.push_back(time);
  const EnsembleForecast run =
      ForecastEnsemble(physics, {}).run(start, wind.spells(from, 600), times, {}, truth);

  LearningDay day;
  day.plot = seen.plot;
  for (WindSample sample : seen.wind) {
    sample.time -= from;
    if (sample.time >= 0) day.wind.push_back(sample);
  }
  day.surface.push_back(seen.at(from));
  for (const Forecast& forecast : run.forecasts) day.surface.push_back(forecast.map.layer(layer::elevation));
  return day;
}

struct Recovered {
  Values error{};  ///< of the logarithms
  Values spread{};
};

Recovered learn(const LearningDay& day, std::uint64_t seed) {
  LearningTwin::Settings settings;
  settings.seed = seed;
  settings.border = Border::open;
  settings.learner.least_spread = 0;
  LearningTwin twin(day, settings);
  twin.learn_from_hindcasts(0, 600, 60);
  const Values found = twin.learner().median().values();
  const Values should = truth.values();
  const auto& members = twin.learner().members();
  Recovered result;
  for (std::size_t j = 0; j < found.size(); ++j) {
    result.error[j] = std::log(found[j] / should[j]);
    double sum = 0;
    for (const UncertainParameters& member : members)
      sum += std::pow(std::log(member.values()[j] / found[j]), 2);
    result.spread[j] = std::sqrt(sum / static_cast<double>(members.size() - 1));
  }
  return result;
}

double rms(const std::vector<Recovered>& all, Values Recovered::*what, std::size_t parameter) {
  double sum = 0;
  for (const Recovered& each : all) sum += std::pow((each.*what)[parameter], 2);
  return std::sqrt(sum / static_cast<double>(all.size()));
}

void rows(AccuracyTable& table, const std::string& folder, double from, const std::string& title,
          const std::string& words) {
  table.section(title, words);
  std::vector<Recovered> all(beds);
  tbb::parallel_for(std::uint64_t{0}, beds, [&](std::uint64_t i) {
    all[i] = learn(model_day(learning_day(i + 1, folder), from), i + 1);
  });
  const Values should = truth.values();
  for (std::size_t j = 0; j < should.size(); ++j) {
    const std::string& name = UncertainParameters::names()[j];
    const double prior = default_priors()[j].sigma;
    const double error = 100 * rms(all, &Recovered::error, j);
    if (j == 0)
      table.range_row(name + ": error [%]", 0, 5, error);
    else
      table.remark(
          fmt::format("{}: error [%], of {:.0f} to be found", name, 100 * std::abs(std::log(should[j]))), 0,
          error);
    table.remark(fmt::format("{}: spread that is left / the prior's", name), 0,
                 rms(all, &Recovered::spread, j) / prior);
  }
}

}  // namespace

void same_model_rows(AccuracyTable& table, const std::string& folder) {
  rows(
      table, folder, 0, "Which parameters come back: young ripples",
      "Truth is the twin's own model over open borders with friction velocity 1.10, reptation length 1.20, "
      "impact "
      "angle 0.88, repose angle 0.95 and sand supply 1.25 times what the twin is given, from the beds of six "
      "lattice days when they begin (relief of 1 to 2 mm). 0.2 mm of noise, ten minutes of learning from a "
      "map a "
      "minute, 20 members, default priors, no inflation. RMS over the beds. A spread of 1 is that of the "
      "prior: "
      "nothing was learned.");
  rows(table, folder, 600, "Which parameters come back: ripples ten minutes older",
       "The same from the beds after ten minutes of the day.");
}

}  // namespace aeolian
