#include "aeolian_core/slide/surrogate/cross_validation.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr int inner_folds = 5;

std::vector<int> shuffled_folds(std::size_t count, int folds, std::uint64_t seed) {
  constexpr Require require{"cross-validation"};
  require(folds >= 2 && static_cast<std::size_t>(folds) <= count, "number of folds", folds,
          "from 2 to the number of runs");
  std::vector<int> result(count);
  for (std::size_t k = 0; k < count; ++k) result[k] = static_cast<int>(k % static_cast<std::size_t>(folds));
  RandomStream random(seed, 0);
  for (std::size_t k = count; k > 1; --k)
    std::swap(result[k - 1], result[static_cast<std::size_t>(random.uniform() * static_cast<double>(k))]);
  return result;
}

double mean_absolute_error(const TrainingRows& rows, const std::vector<double>& predicted) {
  double sum = 0;
  for (std::size_t k = 0; k < predicted.size(); ++k) sum += std::abs(predicted[k] - rows.targets[k]);
  return sum / static_cast<double>(predicted.size());
}

int folds_in(const std::vector<int>& folds) { return *std::max_element(folds.begin(), folds.end()) + 1; }

void predict_fold(const TrainingRows& rows, const std::vector<int>& folds, int fold,
                  const SvrSettings& settings, std::vector<double>& predicted) {
  const TrainingRows others = rows.without(folds, fold);
  const auto trained = SupportVectors::train(others.features, others.targets, settings);
  for (std::size_t k = 0; k < folds.size(); ++k)
    if (folds[k] == fold) predicted[k] = trained.at(rows.features[k]);
}

}  // namespace

TrainingRows TrainingRows::without(const std::vector<int>& folds, int fold) const {
  TrainingRows others;
  for (std::size_t k = 0; k < folds.size(); ++k) {
    if (folds[k] == fold) continue;
    others.features.push_back(features[k]);
    others.targets.push_back(targets[k]);
    others.runs.push_back(runs[k]);
  }
  return others;
}

std::vector<int> grouped_folds(const std::vector<int>& runs, int folds, std::uint64_t seed) {
  std::map<int, std::size_t> number;
  for (const int run : runs) number.emplace(run, 0);
  std::size_t next = 0;
  for (auto& [run, place] : number) place = next++;
  const std::vector<int> of_run = shuffled_folds(number.size(), folds, seed);
  std::vector<int> result;
  for (const int run : runs) result.push_back(of_run[number.at(run)]);
  return result;
}

std::vector<int> leaking_folds(std::size_t rows, int folds, std::uint64_t seed) {
  return shuffled_folds(rows, folds, seed);
}

std::vector<double> out_of_fold(const TrainingRows& rows, const std::vector<int>& folds,
                                const SvrSettings& settings) {
  std::vector<double> predicted(folds.size());
  for (int fold = 0; fold < folds_in(folds); ++fold) predict_fold(rows, folds, fold, settings, predicted);
  return predicted;
}

SvrSettings best_settings(const TrainingRows& rows, const std::vector<int>& folds, SvrKernel kernel,
                          const SvrGrid& grid) {
  std::vector<SvrSettings> all;
  const bool linear = kernel == SvrKernel::linear;
  const std::vector<double> gammas = linear ? std::vector<double>{1} : grid.gamma;
  for (const double tolerance : grid.tolerance)
    for (const double gamma : gammas)
      for (const double cost : linear ? grid.linear_cost : grid.rbf_cost)
        all.push_back({kernel, cost, tolerance, gamma});
  std::vector<double> errors(all.size());
  tbb::parallel_for(std::size_t{0}, all.size(), [&](std::size_t k) {
    errors[k] = mean_absolute_error(rows, out_of_fold(rows, folds, all[k]));
  });
  return all[static_cast<std::size_t>(std::min_element(errors.begin(), errors.end()) - errors.begin())];
}

std::vector<double> nested_out_of_fold(const TrainingRows& rows, const std::vector<int>& folds,
                                       SvrKernel kernel, std::uint64_t seed, const SvrGrid& grid) {
  std::vector<double> predicted(folds.size());
  for (int fold = 0; fold < folds_in(folds); ++fold) {
    const TrainingRows others = rows.without(folds, fold);
    const SvrSettings best =
        best_settings(others, grouped_folds(others.runs, inner_folds, seed), kernel, grid);
    predict_fold(rows, folds, fold, best, predicted);
  }
  return predicted;
}

}  // namespace aeolian
