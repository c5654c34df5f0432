#pragma once

#include <vector>

namespace aeolian {

/// How a set of parameters did against measured piles: root mean squares of its errors [m].
struct PileErrors {
  double height = 0;
  double length = 0;
};

/// The score of each set: its errors rescaled from 0, the best of all sets, to 1, the worst (Frischholz eq.
/// 3.4.1), the mean of height and length. The smallest wins. Throws Error when there are no two sets that
/// differ.
std::vector<double> rescaled_scores(const std::vector<PileErrors>& sets);

}  // namespace aeolian
