#include "aeolian_core/slide/calibration/rescaled_score.hpp"

#include <algorithm>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

std::vector<double> rescaled_scores(const std::vector<PileErrors>& sets) {
  std::vector<double> scores(sets.size(), 0);
  for (const auto which : {&PileErrors::height, &PileErrors::length}) {
    const auto less = [&](const PileErrors& a, const PileErrors& b) { return a.*which < b.*which; };
    const auto ends = std::minmax_element(sets.begin(), sets.end(), less);
    if (sets.empty() || !((*ends.second).*which > (*ends.first).*which))
      throw Error("calibration: errors of all sets are the same, must differ to be rescaled");
    const double low = (*ends.first).*which;
    const double range = (*ends.second).*which - low;
    for (std::size_t k = 0; k < sets.size(); ++k) scores[k] += 0.5 * (sets[k].*which - low) / range;
  }
  return scores;
}

}  // namespace aeolian
