#pragma once

#include <vector>

namespace aeolian {

/// Robust local quadratic regression (Cleveland 1979) of noisy values at rising places.
struct LocalQuadratic {
  std::vector<double> fit;       ///< at each place
  std::vector<double> slope;     ///< its derivative
  std::vector<double> leverage;  ///< weight of a place's own value in its fit
  std::vector<double>
      noise_gain;  ///< root of the sum of squared weights: noise of the fit over that of a value
  std::vector<double> robust_weight;  ///< 1 for good values, 0 for outliers
};

/// Values within `half_width` of a place count, with tricube weights; outliers (beyond six median deviations)
/// not at all, nor do NaN. A place with fewer than five neighbours keeps NaN.
LocalQuadratic local_quadratic(const std::vector<double>& x, const std::vector<double>& y, double half_width);

}  // namespace aeolian
