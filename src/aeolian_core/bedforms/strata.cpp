#include "aeolian_core/bedforms/strata.hpp"

#include <algorithm>

namespace aeolian {

Strata::Strata(std::size_t cells, int remembered, double thickness, double bulk)
    : remembered_(remembered),
      thickness_(thickness),
      bulk_(bulk),
      coarse_(cells * static_cast<std::size_t>(remembered)),
      newest_(cells),
      many_(cells),
      deep_(cells),
      deep_coarse_(cells) {}

std::size_t Strata::slot(std::size_t cell, int k) const {
  const int ahead = newest_[cell] - k;
  const int place = ahead < 0 ? ahead + remembered_ : ahead;
  return cell * static_cast<std::size_t>(remembered_) + static_cast<std::size_t>(place);
}

void Strata::bury(std::size_t cell, float coarse) {
  if (many_[cell] == remembered_) {
    deep_[cell] += thickness_;
    deep_coarse_[cell] += static_cast<double>(coarse_[slot(cell, remembered_ - 1)]);
    --many_[cell];
  }
  newest_[cell] = static_cast<std::uint8_t>(newest_[cell] + 1 < remembered_ ? newest_[cell] + 1 : 0);
  ++many_[cell];
  coarse_[slot(cell, 0)] = coarse;
}

double Strata::unearth(std::size_t cell) {
  if (many_[cell] > 0) {
    const auto coarse = static_cast<double>(coarse_[slot(cell, 0)]);
    newest_[cell] = static_cast<std::uint8_t>(newest_[cell] > 0 ? newest_[cell] - 1 : remembered_ - 1);
    --many_[cell];
    return coarse;
  }
  if (deep_[cell] > thickness_) {
    const double coarse = deep_coarse_[cell] * (thickness_ / deep_[cell]);
    deep_[cell] -= thickness_;
    deep_coarse_[cell] -= coarse;
    return coarse;
  }
  const double coarse = deep_coarse_[cell] + bulk_ * (thickness_ - deep_[cell]);
  deep_[cell] = deep_coarse_[cell] = 0;
  return coarse;
}

double Strata::fraction(std::size_t cell, int k) const {
  if (k < many_[cell]) return std::clamp(static_cast<double>(coarse_[slot(cell, k)]) / thickness_, 0.0, 1.0);
  const double below = (k - many_[cell]) * thickness_;
  return below < deep_[cell] ? deep_coarse_[cell] / deep_[cell] : bulk_;
}

double Strata::excess(std::size_t cell) const {
  double sum = deep_coarse_[cell] - bulk_ * deep_[cell];
  for (int k = 0; k < many_[cell]; ++k)
    sum += static_cast<double>(coarse_[slot(cell, k)]) - bulk_ * thickness_;
  return sum;
}

}  // namespace aeolian
