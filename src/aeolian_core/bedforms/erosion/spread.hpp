#pragma once

#include <array>
#include <cstdint>

#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"

namespace aeolian {

/// The cells that share what happens at a place, and how it is divided among them: the four about it with
/// bilinear weights, or the nearest alone. Beyond open borders the outermost cells serve.
class Spread {
 public:
  /// `x`, `y` in cells from the centre of cell (0, 0).
  Spread(const ErodibleBed& bed, float x, float y, bool bilinear);

  /// Loose grains, what of them there is. Returns the units taken.
  std::int32_t take_loose(ErodibleBed& bed, std::int32_t units) const;
  /// So many or none: loose ones, first from where they should come; else sintered ones of the nearest cell.
  bool take_parcel(ErodibleBed& bed, std::int32_t units) const;
  /// Adds loose grains; what would come down in a hole is returned. `landed(cell, units)` is told.
  template <class Landed>
  std::int32_t give(ErodibleBed& bed, std::int32_t units, Landed&& landed) const {
    std::int32_t lost = 0;
    const std::array<std::int32_t, 4> parts = divide(units);
    for (int n = 0; n < count_; ++n) {
      const std::int32_t part = parts[static_cast<std::size_t>(n)];
      if (part == 0) continue;
      const CellIndex c = cells_[static_cast<std::size_t>(n)];
      const std::size_t cell = bed.geometry().index(c);
      if (bed.hole(cell)) {
        lost += part;
        continue;
      }
      bed.add_loose(c, part);
      landed(cell, part);
    }
    return lost;
  }

 private:
  /// Whole units for each cell; the nearest, which is the first, has what is left.
  std::array<std::int32_t, 4> divide(std::int32_t units) const;

  int count_;
  std::array<CellIndex, 4> cells_;
  std::array<float, 4> weights_;
};

}  // namespace aeolian
