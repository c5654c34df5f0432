#include <cmath>
#include <set>

#include "slide_rows.hpp"

#include "aeolian_core/slide/surrogate/slide_surrogate.hpp"

namespace aeolian {
namespace {

constexpr int folds = 10;

/// Of the number itself, not its logarithm; and in parts of it.
struct Errors {
  double mean = 0;
  double part = 0;
};

Errors errors_of(const TrainingRows& rows, const std::vector<double>& predicted) {
  Errors e;
  const auto n = static_cast<double>(predicted.size());
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    const double there = std::exp(rows.targets[k]);
    const double off = std::abs(std::exp(predicted[k]) - there);
    e.mean += off / n;
    e.part += off / there / n;
  }
  return e;
}

struct Coverage {
  double height = 0, length = 0, shape = 0;
};

/// How often intervals hold for runs that were not learnt from.
Coverage coverage_of(const PileTable& table, SvrKernel kernel) {
  const TrainingRows rows = rows_of(table, [](const PileRecord& r) { return r.height; });
  const std::vector<int> fold_of = grouped_folds(rows.runs, folds, 2);
  Coverage coverage;
  const double one = 1 / static_cast<double>(table.size());
  for (int fold = 0; fold < folds; ++fold) {
    PileTable others;
    for (std::size_t k = 0; k < table.size(); ++k)
      if (fold_of[k] != fold) others.push_back(table[k]);
    SlideSurrogate::Settings settings;
    settings.kernel = kernel;
    const auto surrogate = SlideSurrogate::train(others, settings);
    for (std::size_t k = 0; k < table.size(); ++k) {
      if (fold_of[k] != fold) continue;
      const PilePrediction pile = surrogate.predict_anywhere(table[k].query);
      const auto holds = [](const Estimate& e, double value) { return e.low <= value && value <= e.high; };
      coverage.height += holds(pile.height, table[k].height) ? one : 0;
      coverage.length += holds(pile.length, table[k].length) ? one : 0;
      coverage.shape += holds(pile.shape, table[k].shape()) ? one : 0;
    }
  }
  return coverage;
}

}  // namespace

void slide_surrogate_rows(AccuracyTable& table) {
  const PileTable piles = read_pile_table(AEOLIAN_REPOSITORY "/config/slide/piles_2d.csv");
  std::set<int> runs;
  for (const PileRecord& r : piles) runs.insert(r.run);
  table.section(
      "Surrogate",
      fmt::format(
          "Support vectors on config/slide/piles_2d.csv: {} piles of {} panels, two dimensions, T/dx = 3. "
          "Specification, sections 3.6 and 5 E: the thesis' mean absolute errors are of 610 piles with folds "
          "that "
          "leak. Folds of whole runs, with settings searched within the others, are the honest figure; they "
          "leave "
          "out corners of the table, too, and must then reach beyond it. Ten folds. "
          "Tolerances of the coverage are two standard errors of so few runs: wide.",
          piles.size(), runs.size()));
  const TrainingRows shape = rows_of(piles, [](const PileRecord& r) { return r.shape(); });
  const TrainingRows height = rows_of(piles, [](const PileRecord& r) { return r.height; });
  const TrainingRows length = rows_of(piles, [](const PileRecord& r) { return r.length; });
  const std::vector<int> leaking = leaking_folds(piles.size(), folds, 1);
  const std::vector<int> grouped = grouped_folds(shape.runs, folds, 1);
  for (const SvrKernel kernel : {SvrKernel::rbf, SvrKernel::linear}) {
    const bool rbf = kernel == SvrKernel::rbf;
    const char* name = rbf ? "RBF" : "linear";
    const double bar = rbf ? 0.004 : 0.015;
    const auto leaky = out_of_fold(shape, leaking, best_settings(shape, leaking, kernel));
    table.range_row(fmt::format("{}: mean absolute error of H/L, folds that leak", name), 0, bar,
                    errors_of(shape, leaky).mean);
    const Errors honest = errors_of(shape, nested_out_of_fold(shape, grouped, kernel, 1));
    table.range_row(fmt::format("{}: mean absolute error of H/L, folds of whole runs", name), 0, bar,
                    honest.mean);
    table.remark(fmt::format("{}: the same in parts of H/L", name), rbf ? 0.04 : 0.16, honest.part);
    table.range_row(fmt::format("{}: mean error of the height in parts, folds of whole runs", name), 0, 0.1,
                    errors_of(height, nested_out_of_fold(height, grouped, kernel, 1)).part);
    table.range_row(fmt::format("{}: mean error of the length in parts, folds of whole runs", name), 0, 0.2,
                    errors_of(length, nested_out_of_fold(length, grouped, kernel, 1)).part);
    const Coverage held = coverage_of(piles, kernel);
    const double error = std::sqrt(0.09 / static_cast<double>(runs.size()));
    table.row(fmt::format("{}: interval of 90 % holds for H/L of runs not learnt from", name), 0.9,
              held.shape, 2 * error, error);
    table.row(fmt::format("{}: the same for the height", name), 0.9, held.height, 2 * error, error);
    table.row(fmt::format("{}: the same for the length", name), 0.9, held.length, 2 * error, error);
  }
}

}  // namespace aeolian
