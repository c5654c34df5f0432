#include "aeolian_core/slide/calibration/rescaled_score.hpp"

#include <algorithm>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

ErrorScale::ErrorScale(const std::vector<PileErrors>& sets) {
  for (const auto which : {&PileErrors::height, &PileErrors::length}) {
    const auto less = [&](const PileErrors& a, const PileErrors& b) { return a.*which < b.*which; };
    const auto ends = std::minmax_element(sets.begin(), sets.end(), less);
    if (sets.empty() || !((*ends.second).*which > (*ends.first).*which))
      throw Error("calibration: errors of all sets are the same, must differ to be rescaled");
    low_.*which = (*ends.first).*which;
    range_.*which = (*ends.second).*which - low_.*which;
  }
}

double ErrorScale::score(const PileErrors& errors) const {
  return 0.5 *
         ((errors.height - low_.height) / range_.height + (errors.length - low_.length) / range_.length);
}

std::vector<double> rescaled_scores(const std::vector<PileErrors>& sets) {
  const ErrorScale scale(sets);
  std::vector<double> scores;
  for (const PileErrors& errors : sets) scores.push_back(scale.score(errors));
  return scores;
}

}  // namespace aeolian
