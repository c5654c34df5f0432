#pragma once

#include <algorithm>
#include <cmath>

namespace aeolian {

/// Mean and standard deviation of numbers, with their standard errors.
class Sample {
 public:
  void add(double x) {
    n_ += 1;
    const double off = x - mean_;
    mean_ += off / n_;
    squares_ += off * (x - mean_);
    fourth_ += off * off * off * off;
  }
  double count() const { return n_; }
  double mean() const { return mean_; }
  double deviation() const { return n_ > 0 ? std::sqrt(squares_ / n_) : 0; }
  double error() const { return n_ > 0 ? deviation() / std::sqrt(n_) : 0; }
  /// From the fourth moment, for distributions of any shape.
  double deviation_error() const {
    const double variance = squares_ / n_;
    return std::sqrt(std::max(0.0, fourth_ / n_ - variance * variance) / n_) / (2 * deviation());
  }

 private:
  double n_ = 0, mean_ = 0, squares_ = 0, fourth_ = 0;
};

}  // namespace aeolian
