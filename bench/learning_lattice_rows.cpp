#include <algorithm>
#include <cmath>
#include <numeric>

#include "learning_rows.hpp"
#include "learning_twin.hpp"
#include <tbb/parallel_for.h>

#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/twin/translation.hpp"

namespace aeolian {
namespace {

constexpr std::uint64_t seeds = 24;
constexpr double taught = 600;          // [s] of learning
constexpr double period = 60;           // between the maps learned from [s]
constexpr double lead = 300;            // of the forecasts that are scored [s]
constexpr double longest_shift = 0.04;  // of translations: more than half a wavelength [m]

double square(double value) { return value * value; }

double mean_square(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    sum += square(static_cast<double>(a[i]) - static_cast<double>(b[i]));
  return sum / static_cast<double>(a.size());
}

/// RMS errors of forecasts begun each minute after learning [m].
struct Errors {
  double learned = 0, prior = 0, persistence = 0, translation = 0;
};

struct Outcome {
  double wind_factor = 0;
  double friction_error = 0;  ///< of the learned friction velocity, relative
  UncertainParameters learned;
  Errors errors;
};

double mean_direction(const LearningDay& day, double from, double until) {
  double sum = 0, count = 0;
  for (const WindSample& sample : day.wind)
    if (sample.time >= from && sample.time < until) sum += sample.direction, ++count;
  return sum / count;
}

Errors errors_of(const LearningDay& day, const LearningTwin& twin, const UncertainParameters& learned) {
  Errors sum;
  double count = 0;
  for (double time = taught; time + lead <= LearningDay::duration; time += 60, ++count) {
    const HeightMap::Layer& truth = day.at(time + lead);
    const HeightMap::Layer start = twin.measured(time).layer(layer::elevation);
    sum.learned += mean_square(twin.forecast(time, lead, learned), truth);
    sum.prior += mean_square(twin.forecast(time, lead, {}), truth);
    sum.persistence += mean_square(start, truth);
    sum.translation += square(
        best_translation(day.plot, start, truth, mean_direction(day, time, time + lead), longest_shift).rmse);
  }
  const auto root = [count](double value) { return std::sqrt(value / count); };
  return {root(sum.learned), root(sum.prior), root(sum.persistence), root(sum.translation)};
}

enum class From { hindcasts, forecasts };

Outcome learn_from(const LearningDay& day, std::uint64_t seed, From from, bool wind_ahead) {
  LearningTwin::Settings settings;
  Outcome outcome;
  outcome.wind_factor = settings.wind_factor = 0.85 + 0.3 * RandomStream(seed, 99).uniform();
  settings.seed = seed;
  settings.wind_ahead = wind_ahead;
  LearningTwin twin(day, settings);
  if (from == From::hindcasts)
    twin.learn_from_hindcasts(0, taught, period);
  else
    twin.learn_from_forecasts(0, taught, period);
  outcome.learned = twin.learner().median();
  outcome.friction_error = outcome.learned.friction_velocity * settings.wind_factor - 1;
  outcome.errors = errors_of(day, twin, outcome.learned);
  return outcome;
}

double worst(std::vector<double> values) { return *std::max_element(values.begin(), values.end()); }

template <class Value>
std::vector<double> of_each(const std::vector<Outcome>& outcomes, const Value& value) {
  std::vector<double> result;
  for (const Outcome& outcome : outcomes) result.push_back(value(outcome));
  return result;
}

void rows(AccuracyTable& table, const std::vector<Outcome>& outcomes, const std::string& title,
          const std::string& words) {
  table.section(title, words);
  const auto friction = of_each(outcomes, [](const Outcome& o) { return std::abs(o.friction_error); });
  const auto still =
      of_each(outcomes, [](const Outcome& o) { return o.errors.learned / o.errors.persistence; });
  const auto moved =
      of_each(outcomes, [](const Outcome& o) { return o.errors.learned / o.errors.translation; });
  const auto gain = of_each(outcomes, [](const Outcome& o) { return o.errors.learned / o.errors.prior; });
  const auto share = [&](const std::vector<double>& values, double limit) {
    const auto count = std::count_if(values.begin(), values.end(), [=](double v) { return v <= limit; });
    return 100.0 * static_cast<double>(count) / static_cast<double>(values.size());
  };
  table.range_row("error of friction velocity, median [%]", 0, 5, 100 * median(friction));
  table.range_row("error of friction velocity, worst day [%]", 0, 5, 100 * worst(friction));
  table.range_row("days on which what was learned forecasts better than the prior [%]", 90, 100,
                  share(gain, 1));
  table.range_row("5-minute forecasts: RMSE / persistence, median", 0, 0.5, median(still));
  table.range_row("the same, worst day", 0, 0.5, worst(still));
  table.range_row("5-minute forecasts: RMSE / best translation, median", 0, 0.9, median(moved));
  table.range_row("days on which it is 0.9 or less [%]", 90, 100, share(moved, 0.9));
  table.remark("RMSE with what was learned / with the prior, median", 1, median(gain));
}

std::string day_table(const std::vector<Outcome>& outcomes) {
  std::string text =
      "| day | anemometer | friction velocity | reptation | angle | repose | learned | prior | persistence | "
      "translation |\n|---|---|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    text += fmt::format(
        "| {} | {:.3f} | {:+.1f} % | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", i + 1,
        o.wind_factor, 100 * o.friction_error, o.learned.reptation_length, o.learned.impact_angle,
        o.learned.repose_angle, 1e3 * o.errors.learned, 1e3 * o.errors.prior, 1e3 * o.errors.persistence,
        1e3 * o.errors.translation);
  }
  return text;
}

}  // namespace

void lattice_day_rows(AccuracyTable& table, const std::string& folder) {
  std::vector<LearningDay> days(seeds);
  tbb::parallel_for(std::uint64_t{0}, seeds, [&](std::uint64_t i) { days[i] = learning_day(i + 1, folder); });
  const auto outcomes_of = [&](From from, bool wind_ahead) {
    std::vector<Outcome> outcomes(seeds);
    tbb::parallel_for(std::uint64_t{0}, seeds,
                      [&](std::uint64_t i) { outcomes[i] = learn_from(days[i], i + 1, from, wind_ahead); });
    return outcomes;
  };

  const auto given = outcomes_of(From::hindcasts, true);
  rows(table, given, "A lattice bed, the wind given ahead",
       "24 days of a bed of single grains (0.51 m × 0.26 m, 0.8 mm columns; friction velocity "
       "0.38 to 0.5 m/s, gusts of 12 %, turns of up to 20° to either side, ripples five to ten minutes old "
       "when "
       "the day begins), seen with 0.2 mm of noise on 2 mm cells by a twin whose anemometer is wrong by a "
       "factor "
       "of 0.85 to 1.15. Default priors, 20 members, ten minutes of learning from a map each minute: "
       "hindcasts "
       "with the wind that blew. Then 5-minute forecasts, one begun each minute from 10 to 15 min; RMSE over "
       "them against the true surface. Model and priors know nothing of the lattice but its defaults.");
  rows(table, outcomes_of(From::hindcasts, false), "The same, the wind to come unknown",
       "The mean wind of the last five minutes goes on: what it cannot know of gusts and turns is in the "
       "errors, "
       "of the prior's forecasts as well.");
  rows(table, outcomes_of(From::forecasts, false), "Learning from forecasts instead",
       "Members that were run ahead, with the wind of the minute before and errors of wind and map: the "
       "misses "
       "are those of the wind as much as of the parameters.");
  table.section(
      "Day by day, the wind given ahead",
      "Anemometer: the factor by which it is wrong; friction velocity: error of what was learned. RMSE in "
      "mm.\n\n" +
          day_table(given));
}

}  // namespace aeolian
