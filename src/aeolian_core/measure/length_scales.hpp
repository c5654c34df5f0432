#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace aeolian {

/// Which lengths repeat in a row of heights (Werner 1987, eq. 5.2): how alike are heights a lag apart.
class LengthScales {
 public:
  /// Detrended heights; sigma is the difference that still counts as alike, in the same unit, positive.
  LengthScales(const std::vector<double>& heights, double sigma);

  /// f at lags of 1 to `lags` samples, divided by its mean. Lags stop below the number of heights.
  std::vector<double> distribution(std::size_t lags) const;
  /// The length [samples] that repeats: the first maximum after the first minimum of a distribution, both
  /// turns deeper than its chance wiggles. Nothing when there is none.
  std::optional<double> dominant(const std::vector<double>& distribution) const;
  /// The maximum within a twenty-fifth about a lag, refined by a parabola over as much to each side.
  std::optional<double> maximum_near(std::size_t lag) const;

 private:
  double alike(std::size_t lag) const;

  Eigen::ArrayXf
      heights_;  ///< in units of sqrt(2) sigma; single precision halves the cost of the exponentials
};

}  // namespace aeolian
