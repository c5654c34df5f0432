#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/slide/surrogate/support_vectors.hpp"

namespace aeolian {

/// Rows to learn from, and the run of each: those of one run are one pile that grows.
struct TrainingRows {
  std::vector<PileFeatures> features;
  std::vector<double> targets;
  std::vector<int> runs;

  TrainingRows without(const std::vector<int>& folds, int fold) const;  ///< the rows of all other folds
};

/// The fold of each row: whole runs, so that no pile is learnt from and asked about. Folds have as even a
/// number of runs as can be. Throws Error for fewer than two folds or more than runs.
std::vector<int> grouped_folds(const std::vector<int>& runs, int folds, std::uint64_t seed);
/// The same row by row. It leaks: a pile is known from its events before and after (the thesis').
std::vector<int> leaking_folds(std::size_t rows, int folds, std::uint64_t seed);

/// What each row is predicted to be by those of the other folds; scales are those of the others, too.
std::vector<double> out_of_fold(const TrainingRows& rows, const std::vector<int>& folds,
                                const SvrSettings& settings);

/// Settings to search, every combination.
struct SvrGrid {
  std::vector<double> tolerance{0.01, 0.1, 0.3};
  std::vector<double> linear_cost{0.01, 0.1,
                                  1};  ///< a plane gains nothing from dearer errors, but takes long
  std::vector<double> rbf_cost{0.1, 1, 10, 100};
  std::vector<double> gamma{0.001, 0.01, 0.1, 1};  ///< of the RBF
};

/// The settings with the smallest mean absolute error out of fold; the first of equals. The result does not
/// depend on the number of threads.
SvrSettings best_settings(const TrainingRows& rows, const std::vector<int>& folds, SvrKernel kernel,
                          const SvrGrid& grid = {});

/// Nested: what each row is predicted to be when settings, too, are searched without its fold (5 folds of
/// whole runs within the others). This is the honest one.
std::vector<double> nested_out_of_fold(const TrainingRows& rows, const std::vector<int>& folds,
                                       SvrKernel kernel, std::uint64_t seed, const SvrGrid& grid = {});

}  // namespace aeolian
