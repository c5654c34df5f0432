#include <algorithm>
#include <cmath>

#include "learning_rows.hpp"
#include "learning_view.hpp"
#include <tbb/parallel_for.h>

#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/twin/forecast_engine.hpp"

namespace aeolian {
namespace {

constexpr std::uint64_t seeds = 24;
constexpr double taught = 600;  // [s] of learning, after which parameters are looked at
constexpr double last = 840;    // forecast begins [s]
constexpr double lead = 300;    // of the forecasts [s]
constexpr double minute = 60;   // [s]
constexpr double every = 120;   // between the forecasts that are scored [s]

/// RMS errors of the forecasts of a part of a day [m].
struct Errors {
  double engine = 0, given = 0, persistence = 0;

  double ratio() const { return engine / given; }
};

struct Outcome {
  double wind_factor = 1;
  UncertainParameters used;     ///< by forecasts after ten minutes
  UncertainParameters learned;  ///< whether used or not
  Errors meanwhile;             ///< of forecasts begun in the first ten minutes
  Errors afterwards;

  double friction_error() const { return std::abs(used.friction_velocity * wind_factor - 1); }
};

class Sum {
 public:
  void add(const HeightMap::Layer& forecast, const HeightMap::Layer& truth) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!std::isfinite(forecast[i])) continue;
      sum_ += std::pow(static_cast<double>(forecast[i]) - static_cast<double>(truth[i]), 2);
      ++count_;
    }
  }
  double root() const { return std::sqrt(sum_ / std::max(1.0, count_)); }

 private:
  double sum_ = 0, count_ = 0;
};

/// Of one part of a day.
struct Sums {
  Sum engine, given, persistence;
  Errors errors() const { return {engine.root(), given.root(), persistence.root()}; }
};

/// What the forecaster does by default, on sand of that grain.
ForecastEngine::Settings engine_settings(Border border) {
  ForecastEngine::Settings settings;
  settings.physics.grain = learning_grain();
  settings.physics.ripple.border = border;
  settings.physics.ripple.wavelength_law = make_wavelength_law("constant", 250);
  settings.ensemble.member_cell = border == Border::open ? 0.006 : 0.004;  // which fit
  settings.wind.window = 300;
  settings.horizons = {lead};
  settings.period = minute;
  settings.learner.emplace();
  return settings;
}

Outcome live_through(const LearningDay& day, const std::vector<HeightMap>& maps, Border border,
                     double wind_factor) {
  const ForecastEngine::Settings settings = engine_settings(border);
  ForecastEngine engine(settings);
  const ForecastEnsemble plain(settings.physics, {});
  Outcome outcome;
  outcome.wind_factor = wind_factor;
  Sums meanwhile, afterwards;
  auto wind = day.wind.begin();
  for (double time = 0; time <= last; time += minute) {
    for (; wind != day.wind.end() && wind->time <= time; ++wind) {
      WindSample read = *wind;
      read.friction_velocity *= wind_factor;
      engine.take_wind(read);
    }
    const auto taken = engine.take_map(maps[static_cast<std::size_t>(time / minute + 0.5)], time);
    if (time == taught) {
      outcome.used = taken.job->median;
      outcome.learned = engine.learner()->median();
    }
    if (time == 0) continue;  // nothing can have been learned
    if (std::fmod(time, every) != 0) continue;
    const auto forecast = [&](const UncertainParameters& parameters) {
      return plain.run(taken.job->start, taken.job->wind, {lead}, {}, parameters)
          .forecasts.front()
          .map.layer(layer::elevation);
    };
    Sums& sums = time < taught ? meanwhile : afterwards;
    const HeightMap::Layer& truth = day.at(time + lead);
    sums.engine.add(forecast(taken.job->median), truth);
    sums.given.add(forecast({}), truth);
    sums.persistence.add(taken.job->start.layer(layer::elevation), truth);
  }
  outcome.meanwhile = meanwhile.errors();
  outcome.afterwards = afterwards.errors();
  return outcome;
}

template <class Value>
std::vector<double> of_each(const std::vector<Outcome>& outcomes, const Value& value) {
  std::vector<double> result;
  for (const Outcome& outcome : outcomes) result.push_back(value(outcome));
  return result;
}

double greatest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

double share_below(const std::vector<double>& values, double limit) {
  const auto count = std::count_if(values.begin(), values.end(), [=](double v) { return v < limit; });
  return 100.0 * static_cast<double>(count) / static_cast<double>(values.size());
}

std::string day_table(const std::vector<Outcome>& outcomes) {
  std::string text =
      "\n\n| day | anemometer | friction velocity used, found | reptation | angle | meanwhile: used, given | "
      "afterwards: used, given, persistence |\n|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    text += fmt::format(
        "| {} | {:.3f} | {:+.1f} %, {:+.1f} % | {:.2f} | {:.2f} | {:.2f}, {:.2f} | {:.2f}, {:.2f}, {:.2f} "
        "|\n",
        i + 1, o.wind_factor, 100 * (o.used.friction_velocity * o.wind_factor - 1),
        100 * (o.learned.friction_velocity * o.wind_factor - 1), o.used.reptation_length, o.used.impact_angle,
        1e3 * o.meanwhile.engine, 1e3 * o.meanwhile.given, 1e3 * o.afterwards.engine,
        1e3 * o.afterwards.given, 1e3 * o.afterwards.persistence);
  }
  return text;
}

void rows(AccuracyTable& table, const std::vector<Outcome>& outcomes, bool is_wrong, const std::string& title,
          const std::string& words) {
  table.section(title, words + day_table(outcomes));
  const auto friction = of_each(outcomes, [](const Outcome& o) { return o.friction_error(); });
  const auto meanwhile = of_each(outcomes, [](const Outcome& o) { return o.meanwhile.ratio(); });
  const auto afterwards = of_each(outcomes, [](const Outcome& o) { return o.afterwards.ratio(); });
  table.range_row("error of the friction velocity used after ten minutes, median [%]", 0, 5,
                  100 * median(friction));
  table.range_row("the same, worst day [%]", 0, 5, 100 * greatest(friction));
  if (is_wrong)
    table.range_row("days on which forecasts after ten minutes are better than with what was given [%]", 90,
                    100, share_below(afterwards, 1));
  table.range_row("RMSE / with what was given, after ten minutes, worst day", 0, 1.05, greatest(afterwards));
  table.range_row("the same in the first ten minutes, worst day", 0, 1.05, greatest(meanwhile));
  table.remark("RMSE / with what was given, after ten minutes, median", 1, median(afterwards));
  table.remark("the same in the first ten minutes, median", 1, median(meanwhile));
}

struct Outcomes {
  std::vector<Outcome> wrong = std::vector<Outcome>(seeds);  ///< anemometer
  std::vector<Outcome> right = std::vector<Outcome>(seeds);
};

Outcomes outcomes_of(const std::string& folder, View view) {
  const Border border = view == View::scanned ? Border::open : Border::periodic;
  Outcomes outcomes;
  tbb::parallel_for(std::uint64_t{0}, seeds, [&](std::uint64_t i) {
    const std::uint64_t seed = i + 1;
    const LearningDay day = learning_day(seed, folder);
    const std::vector<HeightMap> maps = measured_maps(day, view, seed, last);
    const double factor = 0.85 + 0.3 * RandomStream(seed, 99).uniform();
    outcomes.wrong[i] = live_through(day, maps, border, factor);
    outcomes.right[i] = live_through(day, maps, border, 1);
  });
  return outcomes;
}

}  // namespace

void scanned_day_rows(AccuracyTable& table, const std::string& folder) {
  const Outcomes outcomes = outcomes_of(folder, View::scanned);
  rows(
      table, outcomes.wrong, true, "The forecaster on scanned days, the anemometer wrong",
      "The 24 lattice days as the demo's twin sees its own: two scanners with 0.6 mm of noise every ten "
      "seconds, "
      "fused to a live map; open borders over which unknown sand comes; the wind to come unknown. A map each "
      "minute, forecasts of 5 minutes begun from 2 to 14 min, every two minutes, by `ForecastEngine` with "
      "the forecaster's "
      "defaults. The anemometer is wrong by a factor of 0.85 to 1.15. RMSE [mm] against the true surface, of "
      "forecasts begun in the first ten minutes (meanwhile) and later (afterwards). Used: what forecasts "
      "were "
      "made with, which is what was given until what was learned is believed.");
  rows(table, outcomes.right, false, "The forecaster on scanned days, the anemometer right",
       "The same; there is little to learn.");
}

void noisy_day_rows(AccuracyTable& table, const std::string& folder) {
  const Outcomes outcomes = outcomes_of(folder, View::noisy);
  rows(
      table, outcomes.wrong, true, "The forecaster on periodic days, the anemometer wrong",
      "The same days with 0.2 mm of independent noise in each cell, and a forecaster that knows that borders "
      "are joined.");
  rows(table, outcomes.right, false, "The forecaster on periodic days, the anemometer right",
       "The same; there is little to learn.");
}

}  // namespace aeolian
