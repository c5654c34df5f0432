#pragma once

/// How single grains move on a LatticeBed: private to its sources.

#include <array>
#include <cstdint>

#include "aeolian_core/bedforms/lattice/lattice_bed.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {

struct LatticeBed::Column {
  int x, y;
};

/// Which of a set of neighbours (bit 0 east, 1 west, 2 north, 3 south) is meant by a random byte.
struct ChoiceOfNeighbour {
  std::array<std::array<std::uint8_t, 256>, 16> of{};

  constexpr ChoiceOfNeighbour() {
    for (unsigned set = 1; set < 16; ++set) {
      std::array<std::uint8_t, 4> members{};
      unsigned count = 0;
      for (std::uint8_t n = 0; n < 4; ++n)
        if ((set >> n & 1U) != 0) members[count++] = n;
      for (unsigned byte = 0; byte < 256; ++byte) of[set][byte] = members[byte * count / 256];
    }
  }
};
inline constexpr ChoiceOfNeighbour choice;

AEOLIAN_INLINE std::size_t LatticeBed::index(Column at) const {
  return static_cast<std::size_t>(at.y) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(at.x);
}

/// Raises a pocket or lowers a summit by two layers: all its neighbours come to lie on the other side of it.
template <int layers>
AEOLIAN_INLINE void LatticeBed::change(Column at) {
  const std::size_t here = index(at);
  const auto nx = static_cast<std::size_t>(nx_);
  const std::size_t all = height_.size();
  const std::size_t east = at.x + 1 == nx_ ? here + 1 - nx : here + 1;
  const std::size_t west = at.x == 0 ? here + nx - 1 : here - 1;
  const std::size_t north = at.y + 1 == ny_ ? here + nx - all : here + nx;
  const std::size_t south = at.y == 0 ? here + all - nx : here - nx;
  height_[here] = static_cast<std::int16_t>(height_[here] + layers);
  higher_[here] = layers > 0 ? 0 : 15;
  higher_[east] ^= 2U;
  higher_[west] ^= 1U;
  higher_[north] ^= 8U;
  higher_[south] ^= 4U;
}

/// Up or down the slope, at random among the neighbours that are higher or lower, to where there are none.
template <bool up>
AEOLIAN_INLINE LatticeBed::Column LatticeBed::walk(Column at, std::uint32_t& ways) const {
  while (true) {
    const unsigned set = higher_[index(at)] ^ (up ? 0U : 15U);
    if (set == 0) return at;
    const unsigned way = choice.of[set][ways >> 24];
    ways = ways * 0x9E3779B1U + 0x7F4A7C15U;
    const int step = 1 - 2 * static_cast<int>(way & 1U);
    const int along_y = -static_cast<int>(way >> 1);
    at.x += step & ~along_y;
    at.y += step & along_y;
    if (static_cast<unsigned>(at.x) >= static_cast<unsigned>(nx_)) at.x += at.x < 0 ? nx_ : -nx_;
    if (static_cast<unsigned>(at.y) >= static_cast<unsigned>(ny_)) at.y += at.y < 0 ? ny_ : -ny_;
  }
}

}  // namespace aeolian
