#include "aeolian_core/wind/sph/cell_order.hpp"

#include <algorithm>

#include "aeolian_core/surface/require.hpp"

namespace aeolian::sph {
namespace {

constexpr Require require("box of air");

int cells_along(float length, float support) { return static_cast<int>(length / support); }
/// Of a coordinate that may have been rounded up to its border.
int index(float at, float per, int n) { return std::clamp(static_cast<int>(at * per), 0, n - 1); }

}  // namespace

CellOrder::CellOrder(const Torus& torus, float support)
    : torus_(torus),
      nx_(cells_along(torus.length_x, support)),
      ny_(cells_along(torus.length_y, support)),
      nz_(std::max(1, cells_along(torus.height, support))) {
  require(nx_ >= 3, "length along x", static_cast<double>(torus.length_x), "at least three supports");
  require(ny_ >= 3, "length along y", static_cast<double>(torus.length_y), "at least three supports");
  per_x_ = static_cast<float>(nx_) / torus.length_x;
  per_y_ = static_cast<float>(ny_) / torus.length_y;
  per_z_ = static_cast<float>(nz_) / torus.height;
}

std::size_t CellOrder::cell_of(const Four& at) const {
  return cell(index(at[0], per_x_, nx_), index(at[1], per_y_, ny_), index(at[2], per_z_, nz_));
}

void CellOrder::sort(const std::vector<Four>& place) {
  const std::size_t n = place.size();
  first_.assign(static_cast<std::size_t>(nx_ * ny_ * nz_) + 1, 0);
  cell_.resize(n);
  order_.resize(n);
  for_chunks(n, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) cell_[i] = static_cast<std::uint32_t>(cell_of(place[i]));
  });
  for (std::size_t i = 0; i < n; ++i) ++first_[cell_[i] + 1];
  for (std::size_t c = 1; c < first_.size(); ++c) first_[c] += first_[c - 1];
  next_.assign(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < n; ++i) order_[next_[cell_[i]]++] = static_cast<std::uint32_t>(i);
}

}  // namespace aeolian::sph
