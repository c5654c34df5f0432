/// Grains of a LatticeBed that move without wind.

#include "aeolian_core/bedforms/lattice/lattice_column.hpp"

namespace aeolian {

void LatticeBed::compare_neighbours() {
  higher_.assign(height_.size(), 0);
  for (int y = 0; y < ny_; ++y)
    for (int x = 0; x < nx_; ++x) {
      const std::size_t here = index({x, y});
      const std::size_t east = index({x + 1 == nx_ ? 0 : x + 1, y});
      const std::size_t north = index({x, y + 1 == ny_ ? 0 : y + 1});
      if (height_[east] > height_[here])
        higher_[here] |= 1U;
      else
        higher_[east] |= 2U;
      if (height_[north] > height_[here])
        higher_[here] |= 4U;
      else
        higher_[north] |= 8U;
    }
}

LatticeBed::Column LatticeBed::anywhere() {
  const int x = static_cast<int>(random_.uniform() * nx_);
  return {x, static_cast<int>(random_.uniform() * ny_)};
}

void LatticeBed::roughen(double moves_per_column) {
  const auto grains = static_cast<std::int64_t>(moves_per_column * nx_ * ny_);
  for (std::int64_t i = 0; i < grains; ++i) {
    settle(-1);
    settle(1);
  }
}

/// Lays grains down, or takes some away, at random places.
void LatticeBed::settle(std::int64_t grains) {
  for (; grains > 0; --grains) {
    std::uint32_t ways = random_.bits();
    change<2>(walk<false>(anywhere(), ways));
  }
  for (; grains < 0; ++grains) {
    std::uint32_t ways = random_.bits();
    change<-2>(walk<true>(anywhere(), ways));
  }
}

}  // namespace aeolian
