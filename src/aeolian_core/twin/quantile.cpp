#include "aeolian_core/twin/quantile.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

double quantile(std::vector<double>& sample, double share) {
  if (sample.empty()) return NAN;
  const double place = share * static_cast<double>(sample.size() - 1);
  const auto below = sample.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(sample.begin(), below, sample.end());
  const double fraction = place - std::floor(place);
  if (fraction == 0) return *below;  // also keeps an infinite value from becoming NaN
  const double above = *std::min_element(below + 1, sample.end());
  return *below == above ? above : *below + fraction * (above - *below);
}

}  // namespace aeolian
