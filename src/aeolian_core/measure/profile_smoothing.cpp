#include <algorithm>
#include <cmath>
#include <string>

#include <Eigen/Core>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {

std::vector<double> value_weighted_smoothing(const std::vector<double>& values, double sigma, int reach) {
  if (!(sigma >= 0) || reach < 0)
    throw Error("value-weighted smoothing: sigma " + std::to_string(sigma) + ", reach " +
                std::to_string(reach) + ": both must be zero or positive");
  const auto n = static_cast<Eigen::Index>(values.size());
  if (sigma == 0) return values;
  const Eigen::Map<const Eigen::ArrayXd> v(values.data(), n);
  Eigen::ArrayXd weight = Eigen::ArrayXd::Ones(n);
  Eigen::ArrayXd offset = Eigen::ArrayXd::Zero(n);
  // Each pair of samples k apart is weighed once and serves both its ends.
  for (Eigen::Index k = 1; k <= std::min<Eigen::Index>(reach, (n - 1) / 2); ++k) {
    const Eigen::ArrayXd difference = v.tail(n - k) - v.head(n - k);
    // Weights in single precision cost a third and move the result by 1e-7 sigma.
    const Eigen::ArrayXf apart = (difference / (std::sqrt(2.0) * sigma)).cast<float>();
    const Eigen::ArrayXf alike = (-apart.square()).exp();
    const Eigen::ArrayXd w = alike.cast<double>();
    const Eigen::ArrayXd pull = w * difference;
    const Eigen::Index inside = n - 2 * k;
    weight.segment(k, inside) += w.tail(inside) + w.head(inside);
    offset.segment(k, inside) += pull.tail(inside) - pull.head(inside);
  }
  std::vector<double> smooth(values.size());
  Eigen::Map<Eigen::ArrayXd>(smooth.data(), n) = v + offset / weight;
  return smooth;
}

}  // namespace aeolian
