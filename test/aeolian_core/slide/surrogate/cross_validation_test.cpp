#include "aeolian_core/slide/surrogate/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// Runs of five rows that share a random offset: what one row of a run knows of the others, and nobody else.
TrainingRows runs_with_offsets(int runs) {
  RandomStream random(3, 0);
  TrainingRows rows;
  for (int run = 0; run < runs; ++run) {
    const double offset = random.normal();
    const PileFeatures place{random.uniform(), random.uniform(), random.uniform(), 1, 0};
    for (int event = 1; event <= 5; ++event) {
      rows.features.push_back(place);
      rows.features.back()[4] = 0.1 * event;
      rows.targets.push_back(offset + 0.1 * event);
      rows.runs.push_back(run);
    }
  }
  return rows;
}

double mean_error(const TrainingRows& rows, const std::vector<double>& predicted) {
  double sum = 0;
  for (std::size_t k = 0; k < predicted.size(); ++k) sum += std::abs(predicted[k] - rows.targets[k]);
  return sum / static_cast<double>(predicted.size());
}

TEST(CrossValidation, FoldsHoldWholeRunsAndAreEven) {
  const TrainingRows rows = runs_with_offsets(23);
  const auto folds = grouped_folds(rows.runs, 10, 1);
  std::map<int, std::set<int>> folds_of_run, runs_of_fold;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    folds_of_run[rows.runs[k]].insert(folds[k]);
    runs_of_fold[folds[k]].insert(rows.runs[k]);
  }
  for (const auto& [run, of_run] : folds_of_run) EXPECT_EQ(of_run.size(), 1U) << run;
  ASSERT_EQ(runs_of_fold.size(), 10U);
  for (const auto& [fold, runs] : runs_of_fold) EXPECT_TRUE(runs.size() == 2 || runs.size() == 3) << fold;
  EXPECT_EQ(folds, grouped_folds(rows.runs, 10, 1));
  EXPECT_NE(folds, grouped_folds(rows.runs, 10, 2));
}

/// The trap of the specification: with rows of one run on both sides noise looks like knowledge.
TEST(CrossValidation, RowByRowFoldsLeakAndWholeRunsDoNot) {
  const TrainingRows rows = runs_with_offsets(30);
  const SvrSettings settings{SvrKernel::rbf, 100, 0.01, 1};
  const double leaking =
      mean_error(rows, out_of_fold(rows, leaking_folds(rows.targets.size(), 10, 1), settings));
  const double honest = mean_error(rows, out_of_fold(rows, grouped_folds(rows.runs, 10, 1), settings));
  EXPECT_LT(leaking, 0.6 * honest);
  EXPECT_GT(honest, 0.6);
}

TEST(CrossValidation, TheSearchTakesTheKernelWidthThatFits) {
  TrainingRows rows;
  for (int k = 0; k < 100; ++k) {
    rows.features.push_back({0.1 * k, 0, 0, 0, 0});
    rows.targets.push_back(std::sin(0.1 * k));
    rows.runs.push_back(k / 2);
  }
  const SvrGrid grid{{0.01}, {1}, {10}, {0.001, 1}};
  const auto folds = grouped_folds(rows.runs, 10, 1);
  EXPECT_EQ(best_settings(rows, folds, SvrKernel::rbf, grid).gamma, 1);
  EXPECT_LT(mean_error(rows, nested_out_of_fold(rows, folds, SvrKernel::rbf, 1, grid)), 0.05);
}

TEST(CrossValidation, RefusesMoreFoldsThanRuns) {
  const std::vector<int> runs{1, 1, 2, 2};
  EXPECT_EQ(error_of([&] { grouped_folds(runs, 3, 1); }),
            "cross-validation: number of folds is 3, must be from 2 to the number of runs");
  EXPECT_EQ(error_of([&] { grouped_folds(runs, 1, 1); }),
            "cross-validation: number of folds is 1, must be from 2 to the number of runs");
}

}  // namespace
}  // namespace aeolian
