// Impacts in a larger box, and among grains that sleep: nothing changes (splash specification, trap T12).

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>

#include "splash_rows.hpp"

#include "aeolian_core/grains/impacts/impact_statistics.hpp"
#include "aeolian_core/grains/impacts/impact_study.hpp"
#include "aeolian_twin/splash/study_journal.hpp"

namespace aeolian {
namespace {

struct Series {
  std::vector<double> numbers, speeds, rebounds;
  double seconds = 0;  ///< of processor time
  MeanValue number, speed, rebound;
};

ImpactSeries series_of(int impacts) {
  ImpactSeries series;
  series.impacts = impacts;
  series.seed = 5;
  return series;
}

Series numbers_of(const std::vector<ImpactOutcome>& outcomes, const std::vector<Bed<2>>& beds) {
  Series series;
  for (const ImpactOutcome& o : outcomes) {
    series.numbers.push_back(static_cast<double>(o.ejecta.size()));
    if (o.rebound) series.rebounds.push_back(o.rebound->velocity.norm() / o.shot.speed);
    for (const RisenGrain& grain : o.ejecta) series.speeds.push_back(grain.velocity.norm());
  }
  const ImpactStatistics statistics = impact_statistics<2>(outcomes, beds.front());
  series.number = statistics.number;
  series.speed = statistics.ejecta_speed;
  series.rebound = statistics.speed;
  return series;
}

/// Kolmogorov and Smirnov's two-sample distance, over the one that chance passes in one of a hundred cases.
double distance(std::vector<double> a, std::vector<double> b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  double most = 0;
  for (const auto* both : {&a, &b})
    for (const double x : *both) {
      const auto below = [x](const std::vector<double>& v) {
        return static_cast<double>(std::upper_bound(v.begin(), v.end(), x) - v.begin()) /
               static_cast<double>(v.size());
      };
      most = std::max(most, std::abs(below(a) - below(b)));
    }
  const double n = static_cast<double>(a.size());
  const double m = static_cast<double>(b.size());
  return most / (1.63 * std::sqrt((n + m) / (n * m)));
}

void compare(AccuracyTable& table, const std::string& what, const Series& reference, const Series& other) {
  const auto row = [&](const std::string& name, const MeanValue& a, const MeanValue& b) {
    const double error = std::hypot(a.error, b.error);
    table.row(what + ": " + name, a.mean, b.mean, 3 * error, error);
  };
  row("ejecta", reference.number, other.number);
  row("speed of ejecta [m/s]", reference.speed, other.speed);
  row("rebound speed over impact's", reference.rebound, other.rebound);
  table.range_row(what + ": distance of the distributions of numbers (1: chance in 1 of 100 cases)", 0, 1,
                  distance(reference.numbers, other.numbers));
  table.range_row(what + ": distance of the distributions of rebound speeds", 0, 1,
                  distance(reference.rebounds, other.rebounds));
}

Series fired(const std::vector<Bed<2>>& beds, int impacts, const ImpactRules& rules) {
  const std::clock_t begin = std::clock();
  const auto outcomes = fire_series<2>(beds, series_of(impacts), rules);
  const double seconds = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  Series series = numbers_of(outcomes, beds);
  series.seconds = seconds;
  return series;
}

Series noted(const std::string& folder, const std::vector<Bed<2>>& beds, int impacts) {
  std::filesystem::create_directories(folder);
  StudyJournal journal(folder, fmt::format("{} impacts on {} beds\n", impacts, beds.size()), false);
  const auto add = [&](const ImpactOutcome& outcome, int) { journal.add(0, outcome); };
  return numbers_of(fire_series<2>(beds, series_of(impacts), {}, add, nullptr, journal.done(0)), beds);
}

std::vector<Bed<2>> beds_of(int grains, double length, int count) {
  BedRecipe recipe;
  recipe.grains = grains;
  recipe.length = length;
  std::vector<Bed<2>> beds;
  for (int i = 0; i < count; ++i)
    beds.push_back(make_bed(recipe, GrainWorld<2>{}, 20 + static_cast<std::uint64_t>(i)));
  return beds;
}

}  // namespace

void box_rows(AccuracyTable& table, const std::string& folder) {
  constexpr int impacts = 64;
  constexpr int beds = 16;
  table.section(
      "Simulated impacts: a larger box",
      fmt::format("CASE A on level loose beds (trap T12), {} impacts on {} beds each. Tolerance: three "
                  "standard errors of the difference.",
                  impacts, beds));
  const auto small = beds_of(384, 0.673, beds);
  const auto large = beds_of(4 * 384, 2 * 0.673, beds);
  compare(table, "a box twice as wide and deep", noted(folder + "/box", small, impacts),
          noted(folder + "/large_box", large, impacts));
  const auto told = [&](const char* what, double BedState::*number) {
    const auto mean = [&](const std::vector<Bed<2>>& of) {
      std::vector<double> values;
      for (const Bed<2>& bed : of) values.push_back(bed.state.*number);
      return mean_value(values);
    };
    table.remark(std::string("a box twice as wide and deep: ") + what, mean(small).mean, mean(large).mean,
                 std::hypot(mean(small).error, mean(large).error));
  };
  told("coordination of the beds", &BedState::coordination);
  told("packing fraction of the beds", &BedState::packing_fraction);
  told("brinks per diameter", &BedState::roughness);
}

void sleep_rows(AccuracyTable& table) {
  constexpr int impacts = 16;
  table.section(
      "Simulated impacts: sleeping grains",
      "CASE A on a level loose bed of 5000 grains. Sleep: grains below 0.2 sqrt(g d) for 20 contact "
      "times; sqrt(2 g d) takes a grain out of its place. Tolerance: three standard errors of the "
      "difference.");
  const std::vector<Bed<2>> large = beds_of(5000, 125 * 0.0210, 1);
  ImpactRules sleepy;
  sleepy.sleep = {0.2 * std::sqrt(gravity * 0.02), 20 * 7.2e-5};
  const Series awake = fired(large, impacts, {});
  const Series asleep = fired(large, impacts, sleepy);
  compare(table, "5000 grains with sleep", awake, asleep);
  table.range_row("5000 grains: processor time without sleep over that with it", 5, 1000,
                  awake.seconds / asleep.seconds);
}

}  // namespace aeolian
