#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace aeolian {

/// Standard deviation of normal noise over the median of its sizes.
constexpr double sigma_per_median = 1.4826;

/// The middle of some values, the upper of the two middle ones of an even count; NaN of none. They must hold
/// no NaN.
template <class T>
T median(std::vector<T> values) {
  if (values.empty()) return std::numeric_limits<T>::quiet_NaN();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace aeolian
