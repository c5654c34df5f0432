#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace aeolian {

/// Anderson's mixing (1965): a faster way to x = g(x) than repeating x := g(x). What the last few x have
/// changed in g - x tells where it is zero.
class AndersonMixing {
 public:
  explicit AndersonMixing(int memory) : memory_(memory) {}

  /// `x` and what became of it, with the weight of each part in what is to be small. Returns the next x.
  Eigen::VectorXd next(const Eigen::VectorXd& x, const Eigen::VectorXd& g, const Eigen::VectorXd& weight);
  /// For a g that is a little different: the last x no longer counts, what changes did still does.
  void begin_anew() { last_.reset(); }

 private:
  struct Point {
    Eigen::VectorXd result, residual;
  };

  int memory_;
  std::optional<Point> last_;
  std::vector<Point> changes_;  ///< from one x to the next
};

}  // namespace aeolian
