#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "aeolian_core/wind/sph/four.hpp"

namespace aeolian::sph {

/// A box that repeats along x and y, of lengths counted in particle spacings.
struct Torus {
  float length_x = 0, length_y = 0, height = 0;
};

/// A coordinate brought back into a box that repeats.
inline float wrapped(float at, float length) {
  at -= length * std::floor(at / length);
  return at < length ? at : 0;
}

/// Particles in the order of the cells they are in: a counting sort. Cells are at least as long as the
/// kernel's support, x fastest.
class CellOrder {
 public:
  /// At least three cells along x and y. Throws Error for less.
  CellOrder(const Torus& torus, float support);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  int nz() const { return nz_; }
  const Torus& torus() const { return torus_; }
  /// Finds the order of particles at these places, which lie in the box.
  void sort(const std::vector<Four>& place);
  /// Which particle comes at each place of the order.
  const std::vector<std::uint32_t>& order() const { return order_; }
  /// The first of each cell, and one beyond the last.
  const std::vector<std::uint32_t>& first() const { return first_; }
  std::size_t cell(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * static_cast<std::size_t>(ny_) + static_cast<std::size_t>(y)) *
               static_cast<std::size_t>(nx_) +
           static_cast<std::size_t>(x);
  }
  std::size_t cell_of(const Four& at) const;

 private:
  Torus torus_;
  int nx_, ny_, nz_;
  float per_x_, per_y_, per_z_;  ///< cells to a spacing
  std::vector<std::uint32_t> order_, first_, next_, cell_;
};

}  // namespace aeolian::sph
