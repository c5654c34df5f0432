#include "aeolian_core/bedforms/height_map/impact_angles.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

ImpactAngles::ImpactAngles(double mean, double deviation)
    : count_(deviation > 0 ? most : 1), tangent_{std::tan(mean)} {
  if (count_ == 1) return;
  const double ratio = deviation / mean;
  const double variance = std::log1p(ratio * ratio);
  const double middle = std::log(mean) - 0.5 * variance;
  const double apart = std::sqrt(3 * variance);
  const std::array<double, most> nodes{middle, middle - apart, middle + apart};
  std::transform(nodes.begin(), nodes.end(), tangent_.begin(), [](double logarithm) {
    return std::tan(std::clamp(std::exp(logarithm), shallowest, steepest));
  });
}

double ImpactAngles::least_tangent() const {
  return *std::min_element(tangent_.begin(), tangent_.begin() + count_);
}

double ImpactAngles::effective_tangent() const {
  if (count_ == 1) return tangent_[0];
  double mean = 0;
  for (int i = 0; i < count_; ++i) mean += weight(i) / tangent(i);
  return 1 / mean;
}

}  // namespace aeolian
