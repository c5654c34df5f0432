#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

namespace aeolian {

/// Anderson's mixing (1965): a faster way to x = g(x) than repeating x := g(x). The next x is the combination
/// of the last few g for which the same combination of g - x is least.
class AndersonMixing {
 public:
  explicit AndersonMixing(int memory) : memory_(memory) {}

  /// `x` and what became of it, with the weight of each part in what is to be small. Returns the next x.
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& g, const Eigen::VectorXd& weight);
  /// Forgets all but the last x.
  void forget();

 private:
  int memory_;
  std::vector<Eigen::VectorXd> results_;
  std::vector<Eigen::VectorXd> residuals_;
};

}  // namespace aeolian
