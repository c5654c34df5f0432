#include "aeolian_core/bedforms/sorting/strata.hpp"

#include <algorithm>

namespace aeolian {

Strata::Strata(std::size_t cells, int remembered, double thickness, double bulk)
    : remembered_(remembered),
      thickness_(thickness),
      bulk_(bulk),
      coarse_(cells * static_cast<std::size_t>(remembered)),
      columns_(cells) {}

void Strata::bury(std::size_t cell, float coarse) {
  Column& column = columns_[cell];
  if (column.many == remembered_) {
    column.deep += thickness_;
    column.deep_coarse += static_cast<double>(coarse_[slot(cell, remembered_ - 1)]);
    --column.many;
  }
  column.newest = column.newest + 1 < remembered_ ? column.newest + 1 : 0;
  ++column.many;
  coarse_[slot(cell, 0)] = coarse;
}

double Strata::unearth(std::size_t cell) {
  Column& column = columns_[cell];
  if (column.many > 0) {
    const auto coarse = static_cast<double>(coarse_[slot(cell, 0)]);
    column.newest = column.newest > 0 ? column.newest - 1 : remembered_ - 1;
    --column.many;
    return coarse;
  }
  if (column.deep > thickness_) {
    const double coarse = column.deep_coarse * (thickness_ / column.deep);
    column.deep -= thickness_;
    column.deep_coarse -= coarse;
    return coarse;
  }
  const double coarse = column.deep_coarse + bulk_ * (thickness_ - column.deep);
  column.deep = column.deep_coarse = 0;
  return coarse;
}

double Strata::fraction(std::size_t cell, int k) const {
  const Column& column = columns_[cell];
  if (k < column.many) return std::clamp(static_cast<double>(coarse_[slot(cell, k)]) / thickness_, 0.0, 1.0);
  const double below = (k - column.many) * thickness_;
  return below < column.deep ? column.deep_coarse / column.deep : bulk_;
}

double Strata::excess(std::size_t cell) const {
  const Column& column = columns_[cell];
  double sum = column.deep_coarse - bulk_ * (column.deep + column.many * thickness_);
  for (int k = 0; k < column.many; ++k) sum += static_cast<double>(coarse_[slot(cell, k)]);
  return sum;
}

}  // namespace aeolian
