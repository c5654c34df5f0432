#pragma once

#include <vector>

namespace aeolian {

/// How a set of parameters did against measured piles: root mean squares of its errors [m].
struct PileErrors {
  double height = 0;
  double length = 0;
};

/// The scale of scores: errors from 0, the best of some sets, to 1, the worst (Frischholz eq. 3.4.1).
class ErrorScale {
 public:
  /// Throws Error when there are no two sets that differ in both.
  explicit ErrorScale(const std::vector<PileErrors>& sets);

  /// The mean of height and length, rescaled. The smallest wins.
  double score(const PileErrors& errors) const;

 private:
  PileErrors low_, range_;
};

/// The score of each set among all.
std::vector<double> rescaled_scores(const std::vector<PileErrors>& sets);

}  // namespace aeolian
