#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "aeolian_core/surface/grid_geometry.hpp"

namespace aeolian {

/// Sums of some quantities of the known cells over square blocks of a grid, from which the scatter of a mean
/// over all of them follows although neighbours err alike: by the means of blocks, which are independent once
/// blocks are larger than the reach of the correlation (method of batch means, Rolstad, Haug & Denby 2009, J.
/// Glaciol. 55, 666-680, for maps).
///
/// Blocks of 1, 2, 4 ... (8, 16 ... on large maps) cells are tried as long as there are 64 of them. What
/// blocks miss of the correlation falls as one over their side and is extrapolated from two sides (lugsail
/// batch means: Vats & Flegal 2022, Biometrika 109, 735-750); the greatest scatter counts.
template <std::size_t quantities>
class BlockSums {
 public:
  using Sums = std::array<double, quantities>;

  explicit BlockSums(const GridGeometry& geometry)
      : side_(geometry.size() > 62500 ? 8 : 1),
        across_((geometry.nx() + side_ - 1) / side_),
        up_((geometry.ny() + side_ - 1) / side_),
        blocks_(static_cast<std::size_t>(across_) * static_cast<std::size_t>(up_)) {}

  int side() const { return side_; }
  int across() const { return across_; }
  void add(int block_x, int block_y, std::size_t cells, const Sums& sums) {
    Block& block = blocks_[static_cast<std::size_t>(block_y) * static_cast<std::size_t>(across_) +
                           static_cast<std::size_t>(block_x)];
    block.cells += static_cast<double>(cells);
    for (std::size_t q = 0; q < quantities; ++q) block.sums[q] += sums[q];
  }

  double cells() const { return total().cells; }
  double mean(std::size_t quantity) const {
    const Block all = total();
    return all.sums[quantity] / all.cells;
  }

  /// Variance of the mean of a quantity.
  double variance_of_mean(std::size_t quantity) const {
    double greatest = 0;
    for_each_level([&](const std::vector<Block>& blocks, int /*side*/) {
      const Scatter scatter = scatter_of(blocks, quantity);
      if (scatter.cells > 0) greatest = std::max(greatest, scatter.squares / (scatter.cells * scatter.cells));
    });
    return greatest;
  }

  /// How many cells err as one: the integral of the correlation of a quantity of variance `variance` over the
  /// plane, in cells, at least 1. Blocks with few known cells show little of it, which is allowed for.
  double correlation_area(std::size_t quantity, double variance) const {
    Extrapolated largest(1);
    for_each_level([&](const std::vector<Block>& blocks, int side) {
      const Scatter scatter = scatter_of(blocks, quantity);
      if (!(scatter.cells > 0)) return;
      const double ratio = scatter.squares / (scatter.cells * variance);
      const double coverage = scatter.squared_cells / (scatter.cells * side * side);
      largest.take(1 + (ratio - 1) / coverage);
    });
    return largest.value;
  }

 private:
  struct Block {
    double cells = 0;
    Sums sums{};
  };
  struct Scatter {
    double cells = 0;
    double squared_cells = 0;
    double squares = 0;  ///< of blocks' sums about what their cells have on average
  };
  static constexpr int fewest_blocks = 64;

  /// The greatest of a row of values and of where each two in turn lead.
  struct Extrapolated {
    explicit Extrapolated(double least) : value(least) {}
    void take(double next) {
      value = std::max({value, next, 2 * next - last});
      last = next;
    }
    double value;
    double last = std::numeric_limits<double>::infinity();
  };

  static Block sum(const std::vector<Block>& blocks) {
    Block all;
    for (const Block& block : blocks) {
      all.cells += block.cells;
      for (std::size_t q = 0; q < quantities; ++q) all.sums[q] += block.sums[q];
    }
    return all;
  }
  Block total() const { return sum(blocks_); }

  static Scatter scatter_of(const std::vector<Block>& blocks, std::size_t quantity) {
    const Block all = sum(blocks);
    const double mean = all.sums[quantity] / all.cells;
    Scatter result;
    std::size_t used = 0;
    for (const Block& block : blocks) {
      if (block.cells == 0) continue;
      ++used;
      const double off = block.sums[quantity] - block.cells * mean;
      result.squares += off * off;
      result.squared_cells += block.cells * block.cells;
    }
    if (used < 2) return {};
    result.cells = all.cells;
    result.squares *= static_cast<double>(used) / static_cast<double>(used - 1);
    return result;
  }

  template <class Visit>
  void for_each_level(Visit&& visit) const {
    std::vector<Block> blocks = blocks_;
    int across = across_;
    int up = up_;
    for (int side = side_;; side *= 2) {
      visit(blocks, side);
      const int half_across = (across + 1) / 2;
      const int half_up = (up + 1) / 2;
      if (half_across * half_up < fewest_blocks) return;
      std::vector<Block> halved(static_cast<std::size_t>(half_across) * static_cast<std::size_t>(half_up));
      for (int y = 0; y < up; ++y)
        for (int x = 0; x < across; ++x) {
          const Block& from = blocks[static_cast<std::size_t>(y) * static_cast<std::size_t>(across) +
                                     static_cast<std::size_t>(x)];
          Block& to = halved[static_cast<std::size_t>(y / 2) * static_cast<std::size_t>(half_across) +
                             static_cast<std::size_t>(x / 2)];
          to.cells += from.cells;
          for (std::size_t q = 0; q < quantities; ++q) to.sums[q] += from.sums[q];
        }
      blocks = std::move(halved);
      across = half_across;
      up = half_up;
    }
  }

  int side_;
  int across_;
  int up_;
  std::vector<Block> blocks_;
};

/// Sums quantities of each known value: `quantities_of(value)` gives them as doubles.
template <std::size_t quantities, class QuantitiesOf>
BlockSums<quantities> block_sums(const GridGeometry& geometry, const std::vector<float>& values,
                                 QuantitiesOf&& quantities_of) {
  BlockSums<quantities> result(geometry);
  const int side = result.side();
  for (int y = 0; y < geometry.ny(); ++y)
    for (int block = 0; block < result.across(); ++block) {
      const int end = std::min(geometry.nx(), (block + 1) * side);
      typename BlockSums<quantities>::Sums sums{};
      std::size_t cells = 0;
      for (int x = block * side; x < end; ++x) {
        const float value = values[geometry.index(x, y)];
        if (!(std::abs(value) <= std::numeric_limits<float>::max())) continue;
        const auto of_value = quantities_of(static_cast<double>(value));
        for (std::size_t q = 0; q < quantities; ++q) sums[q] += of_value[q];
        ++cells;
      }
      result.add(block, y / side, cells, sums);
    }
  return result;
}

}  // namespace aeolian
