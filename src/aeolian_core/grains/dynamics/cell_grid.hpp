#pragma once

#include <array>
#include <vector>

namespace aeolian {

/// Places of numbered points by square (cubic) cells: who may be near? Points outside the box belong to the
/// cells at its rim, so that the answer is right everywhere.
template <int Dim>
class CellGrid {
 public:
  using Place = std::array<double, Dim>;

  /// Starts anew without points. `period` is infinite where there is none; a periodic axis is covered from
  /// zero to the period.
  void cover(const Place& low, const Place& high, const Place& period, double cell, std::size_t points);

  void insert(int point, const Place& place);
  void erase(int point);
  bool contains(int point) const;
  int cell_of(const Place& place) const;
  /// Orders cells by upright columns, 16 cells wide (in space 6 by 6), and from the bottom to the top of
  /// each: some hundred points in a row are then a compact block with few neighbours outside.
  long rank_of(const Place& place) const;

  /// Calls `found(point)` for each point in the cells that a box of half side `reach` about a place meets.
  template <class Found>
  void visit(const Place& place, double reach, Found found) const {
    std::array<int, 3> from{}, count{1, 1, 1};
    for (int d = 0; d < Dim; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      span(d, place[axis], reach, from[axis], count[axis]);
    }
    for (int k = 0; k < count[2]; ++k)
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) {
          int cell = (from[0] + i) % counts_[0] + counts_[0] * ((from[1] + j) % counts_[1]);
          if constexpr (Dim == 3) cell += counts_[0] * counts_[1] * ((from[2] + k) % counts_[2]);
          for (int point = head_[static_cast<std::size_t>(cell)]; point >= 0;
               point = next_[static_cast<std::size_t>(point)])
            found(point);
        }
  }

 private:
  int index(int axis, double coordinate) const;
  /// The cells along an axis, as a first one and a number that may run over the end of a periodic axis.
  void span(int axis, double coordinate, double reach, int& from, int& count) const;

  Place low_{}, inverse_{};
  std::array<bool, Dim> periodic_{};
  std::array<int, Dim> counts_{};
  std::vector<int> head_;             // first point of each cell, -1: none
  std::vector<int> next_, previous_;  // of each point, in its cell; previous -1: first
  std::vector<int> cell_;             // of each point, -1: not here
};

}  // namespace aeolian
