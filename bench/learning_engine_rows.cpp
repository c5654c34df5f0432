#include <algorithm>
#include <cmath>

#include "learning_rows.hpp"
#include "learning_view.hpp"
#include <tbb/parallel_for.h>

#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/twin/forecast_engine.hpp"
#include "aeolian_core/twin/forecast_spread.hpp"

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
  double engine = 0, given = 0;
  double exact = 0;  ///< with what was given, had the anemometer been right
  double persistence = 0;

  double ratio() const { return engine / given; }
  double best_ratio() const { return exact / given; }
};

struct Outcome {
  double wind_factor = 1;
  UncertainParameters used;     ///< by forecasts after ten minutes
  UncertainParameters learned;  ///< whether used or not
  Errors meanwhile;             ///< of forecasts begun in the first ten minutes
  Errors afterwards;
  Errors known;  ///< afterwards, the wind to come known and where nothing that came over the borders arrived

  double friction_error() const { return std::abs(used.friction_velocity * wind_factor - 1); }
  double learned_error() const { return std::abs(learned.friction_velocity * wind_factor - 1); }
};

class Sum {
 public:
  void add(const HeightMap::Layer& forecast, const HeightMap::Layer& truth,
           const std::vector<bool>* counted = nullptr) {
    for (std::size_t i = 0; i < truth.size(); ++i) {
      if (!std::isfinite(forecast[i]) || (counted != nullptr && !(*counted)[i])) continue;
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
  Sum engine, given, exact, persistence;
  Errors errors() const { return {engine.root(), given.root(), exact.root(), persistence.root()}; }
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

std::vector<WindSample> as_read(const std::vector<WindSample>& wind, double factor) {
  std::vector<WindSample> read = wind;
  for (WindSample& sample : read) sample.friction_velocity *= factor;
  return read;
}

/// The cells in which the border's error is below a tenth of what it is at the border (forecast_spread.hpp).
std::vector<bool> beyond_borders(const Forecast& forecast, const TwinPhysics& physics,
                                 const std::vector<WindSpell>& wind) {
  const GridGeometry& g = forecast.map.geometry();
  std::vector<bool> result(g.size(), true);
  if (physics.ripple.border == Border::periodic) return result;
  std::vector<Forcing> forcings;
  std::vector<double> durations;
  for (const WindSpell& spell : wind) {
    forcings.push_back(forcing_of(physics, spell, {}));
    durations.push_back(spell.until - (durations.empty() ? 0 : wind[durations.size() - 1].until));
  }
  const BorderError border = border_error(forecast, mean_forcing(forcings, durations),
                                          physics.ripple.hop_shortening, physics.ripple.slope_effect);
  for (std::size_t i = 0; i < result.size(); ++i) {
    const CellIndex cell = g.cell_at(i);
    result[i] = border.at(g, g.x(cell.x), g.y(cell.y)) <= 0.1 * border.error;
  }
  return result;
}

/// Forecasts the truth from a day's map in several ways.
class Scores {
 public:
  Scores(const LearningDay& day, const TwinPhysics& physics, double wind_factor)
      : day_(day), physics_(physics), plain_(physics, {}), known_wind_({}) {
    known_wind_.give_ahead(as_read(day.wind, wind_factor));
    exact_.friction_velocity = 1 / wind_factor;
  }

  void add(const ForecastJob& job, bool is_taught) {
    add(job.start, job.wind, job.median, job.time, false, is_taught ? afterwards_ : meanwhile_);
    if (is_taught) add(job.start, known_wind_.spells(job.time, lead), job.median, job.time, true, known_);
  }
  void tell(Outcome& outcome) const {
    outcome.meanwhile = meanwhile_.errors();
    outcome.afterwards = afterwards_.errors();
    outcome.known = known_.errors();
  }

 private:
  void add(const HeightMap& start, const std::vector<WindSpell>& wind, const UncertainParameters& used,
           double time, bool beyond, Sums& sums) const {
    const auto forecast = [&](const UncertainParameters& parameters) {
      return plain_.run(start, wind, {lead}, {}, parameters).forecasts.front();
    };
    const HeightMap::Layer& truth = day_.at(time + lead);
    const Forecast exact = forecast(exact_);
    const std::vector<bool> inner = beyond_borders(exact, physics_, wind);
    const std::vector<bool>* counted = beyond ? &inner : nullptr;
    sums.engine.add(forecast(used).map.layer(layer::elevation), truth, counted);
    sums.given.add(forecast({}).map.layer(layer::elevation), truth, counted);
    sums.exact.add(exact.map.layer(layer::elevation), truth, counted);
    sums.persistence.add(start.layer(layer::elevation), truth, counted);
  }

  const LearningDay& day_;
  TwinPhysics physics_;
  ForecastEnsemble plain_;
  WindCourse known_wind_;
  UncertainParameters exact_;
  Sums meanwhile_, afterwards_, known_;
};

Outcome live_through(const LearningDay& day, const std::vector<HeightMap>& maps, Border border,
                     double wind_factor) {
  const ForecastEngine::Settings settings = engine_settings(border);
  ForecastEngine engine(settings);
  Outcome outcome;
  outcome.wind_factor = wind_factor;
  Scores scores(day, settings.physics, wind_factor);
  const std::vector<WindSample> read = as_read(day.wind, wind_factor);
  auto wind = read.begin();
  for (double time = 0; time <= last; time += minute) {
    for (; wind != read.end() && wind->time <= time; ++wind) engine.take_wind(*wind);
    const auto taken = engine.take_map(maps[static_cast<std::size_t>(time / minute + 0.5)], time);
    if (time == taught) {
      outcome.used = taken.job->median;
      outcome.learned = engine.learner()->median();
    }
    if (time > 0 && std::fmod(time, every) == 0) scores.add(*taken.job, time >= taught);
  }
  scores.tell(outcome);
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
      "afterwards: used, given, exact, persistence | known: used, given, exact "
      "|\n|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const Outcome& o = outcomes[i];
    text += fmt::format(
        "| {} | {:.3f} | {:+.1f} %, {:+.1f} % | {:.2f} | {:.2f} | {:.2f}, {:.2f} | {:.2f}, {:.2f}, {:.2f}, "
        "{:.2f} "
        "| {:.2f}, {:.2f}, {:.2f} |\n",
        i + 1, o.wind_factor, 100 * (o.used.friction_velocity * o.wind_factor - 1),
        100 * (o.learned.friction_velocity * o.wind_factor - 1), o.learned.reptation_length,
        o.learned.impact_angle, 1e3 * o.meanwhile.engine, 1e3 * o.meanwhile.given, 1e3 * o.afterwards.engine,
        1e3 * o.afterwards.given, 1e3 * o.afterwards.exact, 1e3 * o.afterwards.persistence,
        1e3 * o.known.engine, 1e3 * o.known.given, 1e3 * o.known.exact);
  }
  return text;
}

void rows(AccuracyTable& table, const std::vector<Outcome>& outcomes, bool is_wrong, const std::string& title,
          const std::string& words) {
  table.section(title, words + day_table(outcomes));
  const auto used = of_each(outcomes, [](const Outcome& o) { return o.friction_error(); });
  const auto found = of_each(outcomes, [](const Outcome& o) { return o.learned_error(); });
  const auto meanwhile = of_each(outcomes, [](const Outcome& o) { return o.meanwhile.ratio(); });
  const auto afterwards = of_each(outcomes, [](const Outcome& o) { return o.afterwards.ratio(); });
  const auto known = of_each(outcomes, [](const Outcome& o) { return o.known.ratio(); });
  const auto exact = of_each(outcomes, [](const Outcome& o) { return o.afterwards.best_ratio(); });
  const auto known_exact = of_each(outcomes, [](const Outcome& o) { return o.known.best_ratio(); });
  table.range_row("error of the friction velocity found after ten minutes, median [%]", 0, 5,
                  100 * median(found));
  table.range_row("the same, worst day [%]", 0, 5, 100 * greatest(found));
  table.range_row("error of the friction velocity used after ten minutes, worst day [%]", 0, 5,
                  100 * greatest(used));
  if (is_wrong) {
    table.range_row("days on which forecasts after ten minutes are better than with what was given [%]", 90,
                    100, share_below(afterwards, 1));
    table.remark("the same had the anemometer been right and nothing learned [%]", 90, share_below(exact, 1));
    table.range_row("the same, the wind to come known and beyond the reach of the borders [%]", 90, 100,
                    share_below(known, 1));
    table.remark("the same so, had the anemometer been right and nothing learned [%]", 90,
                 share_below(known_exact, 1));
  }
  table.remark(
      "days on which they are the same, as nothing is believed [%]", 0,
      100 - share_below(afterwards, 1) -
          share_below(of_each(outcomes, [](const Outcome& o) { return -o.afterwards.ratio(); }), -1));
  table.range_row("RMSE / with what was given, after ten minutes, worst day", 0, 1.05, greatest(afterwards));
  table.range_row("the same in the first ten minutes, worst day", 0, 1.05, greatest(meanwhile));
  table.remark("RMSE / with what was given, after ten minutes, median", 1, median(afterwards));
  table.remark("the same, the wind to come known and beyond the reach of the borders", 1, median(known));
  table.remark("RMSE / with what was given in the first ten minutes, median", 1, median(meanwhile));
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
      "the "
      "forecaster's defaults. The anemometer is wrong by a factor of 0.85 to 1.15. RMSE [mm] against the "
      "true "
      "surface, of forecasts begun in the first ten minutes (meanwhile) and later (afterwards). Used: what "
      "forecasts were made with, which is what was given until what was learned is believed; reptation and "
      "angle "
      "are those found. Exact: what was given, had the anemometer been right. Known: afterwards, the wind to "
      "come "
      "known to the anemometer and beyond the reach of the borders, where neither weather nor inflow hides "
      "what "
      "was learned.");
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
