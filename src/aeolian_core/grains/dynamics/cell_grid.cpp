#include "aeolian_core/grains/dynamics/cell_grid.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

template <int Dim>
void CellGrid<Dim>::cover(const Place& low, const Place& high, const Place& period, double cell,
                          std::size_t points) {
  // A few far points must not make more cells than there are grains.
  const double most = 4.0 * static_cast<double>(points) + 64;
  double cells = 1;
  for (std::size_t d = 0; d < Dim; ++d)
    cells *= 1 + (std::isfinite(period[d]) ? period[d] : high[d] - low[d]) / cell;
  if (cells > most) cell *= std::pow(cells / most, 1.0 / Dim);

  std::size_t total = 1;
  for (std::size_t d = 0; d < Dim; ++d) {
    periodic_[d] = std::isfinite(period[d]);
    low_[d] = periodic_[d] ? 0 : low[d];
    const double length = periodic_[d] ? period[d] : high[d] - low[d];
    counts_[d] = static_cast<int>(std::clamp(std::floor(length / cell), 1.0, most));
    inverse_[d] = length > 0 ? counts_[d] / length : 0;
    total *= static_cast<std::size_t>(counts_[d]);
  }
  head_.assign(total, -1);
  next_.assign(points, -1);
  previous_.assign(points, -1);
  cell_.assign(points, -1);
}

template <int Dim>
void CellGrid<Dim>::insert(int point, const Place& place) {
  const auto p = static_cast<std::size_t>(point);
  if (p >= cell_.size()) {
    next_.resize(p + 1, -1);
    previous_.resize(p + 1, -1);
    cell_.resize(p + 1, -1);
  }
  const int cell = cell_of(place);
  int& head = head_[static_cast<std::size_t>(cell)];
  cell_[p] = cell;
  next_[p] = head;
  previous_[p] = -1;
  if (head >= 0) previous_[static_cast<std::size_t>(head)] = point;
  head = point;
}

template <int Dim>
void CellGrid<Dim>::erase(int point) {
  const auto p = static_cast<std::size_t>(point);
  if (next_[p] >= 0) previous_[static_cast<std::size_t>(next_[p])] = previous_[p];
  if (previous_[p] >= 0)
    next_[static_cast<std::size_t>(previous_[p])] = next_[p];
  else
    head_[static_cast<std::size_t>(cell_[p])] = next_[p];
  cell_[p] = -1;
}

template <int Dim>
bool CellGrid<Dim>::contains(int point) const {
  const auto p = static_cast<std::size_t>(point);
  return p < cell_.size() && cell_[p] >= 0;
}

template <int Dim>
int CellGrid<Dim>::cell_of(const Place& place) const {
  int cell = 0;
  for (int d = Dim - 1; d >= 0; --d)
    cell = cell * counts_[static_cast<std::size_t>(d)] + index(d, place[static_cast<std::size_t>(d)]);
  return cell;
}

template <int Dim>
long CellGrid<Dim>::rank_of(const Place& place) const {
  constexpr int side = Dim == 2 ? 16 : 6;
  std::array<int, Dim - 1> across;
  long rank = 0;
  for (std::size_t d = Dim - 1; d-- > 0;) {
    across[d] = index(static_cast<int>(d), place[d]);
    rank = rank * (counts_[d] / side + 1) + across[d] / side;
  }
  rank = rank * counts_[Dim - 1] + index(Dim - 1, place[Dim - 1]);
  for (std::size_t d = Dim - 1; d-- > 0;) rank = rank * side + across[d] % side;
  return rank;
}

template <int Dim>
int CellGrid<Dim>::index(int axis, double coordinate) const {
  const auto d = static_cast<std::size_t>(axis);
  return static_cast<int>(std::clamp((coordinate - low_[d]) * inverse_[d], 0.0, counts_[d] - 1.0));
}

template <int Dim>
void CellGrid<Dim>::span(int axis, double coordinate, double reach, int& from, int& count) const {
  const auto d = static_cast<std::size_t>(axis);
  if (!periodic_[d]) {
    from = index(axis, coordinate - reach);
    count = index(axis, coordinate + reach) - from + 1;
    return;
  }
  const int cells = counts_[d];
  const auto cell = [&](double x) { return static_cast<int>(std::floor((x - low_[d]) * inverse_[d])); };
  from = cell(coordinate - reach);
  count = std::min(cell(coordinate + reach) - from + 1, cells);
  from = (from % cells + cells) % cells;
}

template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace aeolian
