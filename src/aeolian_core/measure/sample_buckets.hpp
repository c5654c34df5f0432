#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "aeolian_core/measure/fixed_point.hpp"

namespace aeolian {

/// Samples by tile: for each tile a chain of small blocks out of one pool, which is kept for the next cloud.
/// Tiles are then worked on one after the other, each in the fast cache.
class SampleBuckets {
 public:
  /// Empties the buckets.
  void clear() {
    std::fill(chains_.begin(), chains_.end(), Chain());
    blocks_.clear();
  }
  /// Makes place for tiles below `tiles`.
  void reserve(std::size_t tiles) {
    if (chains_.size() < tiles) chains_.resize(tiles);
  }
  /// Adds samples, each to its tile; negative tiles: none.
  void add(const std::int32_t* tiles, const Sample* samples, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (tiles[i] < 0) continue;
      Chain& chain = chains_[static_cast<std::size_t>(tiles[i])];
      if (chain.room == 0) append_block(chain);
      blocks_[chain.last].samples[block_size - chain.room--] = samples[i];
    }
  }
  bool has(std::size_t tile) const { return tile < chains_.size() && chains_[tile].first != none; }
  /// Calls `visit(samples, count)` for each block of a tile.
  template <class Visit>
  void for_each(std::size_t tile, Visit&& visit) const {
    if (!has(tile)) return;
    for (std::uint32_t at = chains_[tile].first; at != none; at = blocks_[at].next)
      visit(blocks_[at].samples.data(),
            at == chains_[tile].last ? block_size - chains_[tile].room : block_size);
  }

 private:
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  static constexpr std::uint32_t block_size = 31;
  struct Block {
    std::array<Sample, block_size> samples;
    std::uint32_t next;
  };
  struct Chain {
    std::uint32_t first = none;
    std::uint32_t last = none;
    std::uint32_t room = 0;  ///< in the last block
  };

  void append_block(Chain& chain) {
    const auto at = static_cast<std::uint32_t>(blocks_.size());
    blocks_.emplace_back();
    blocks_.back().next = none;
    if (chain.last == none)
      chain.first = at;
    else
      blocks_[chain.last].next = at;
    chain.last = at;
    chain.room = block_size;
  }

  std::vector<Chain> chains_;
  std::vector<Block> blocks_;
};

}  // namespace aeolian
