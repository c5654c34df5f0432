#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "aeolian_core/measure/fixed_point.hpp"

namespace aeolian {

/// Samples by tile: for each tile a chain of blocks out of one pool, which is kept for the next cloud. Tiles
/// are then worked on one after the other, each in the fast cache.
class SampleBuckets {
 public:
  /// Empties the buckets and makes room for so many samples in tiles below `tiles`.
  void reset(std::size_t tiles, std::size_t samples) {
    ends_.assign(tiles, End());
    first_.assign(tiles, none);
    used_ = 0;
    const std::size_t blocks = samples / block_size + std::min(tiles, samples) + blocks_ahead + 1;
    const std::size_t room = blocks * stride;
    if (room <= room_) return;
    room_ = room;
    pool_.reset(new Sample[room]);  // pages that are never used cost nothing
  }
  bool empty() const { return used_ == 0; }
  /// Adds samples, each to its tile; negative tiles: none.
  void add(const std::int32_t* tiles, const Sample* samples, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      if (tiles[i] < 0) continue;
      const auto tile = static_cast<std::size_t>(tiles[i]);
      End& end = ends_[tile];
      if (end.next == end.link) append_block(tile);
      pool_[end.next++] = samples[i];
    }
  }
  bool has(std::size_t tile) const { return tile < first_.size() && first_[tile] != none; }
  /// Lets the processor fetch a tile's first samples.
  void prefetch(std::size_t tile) const {
    if (has(tile)) prefetch_block(first_[tile]);
  }
  /// Calls `visit(samples, count)` for each block of a tile.
  template <class Visit>
  void for_each(std::size_t tile, Visit&& visit) const {
    if (!has(tile)) return;
    const End& end = ends_[tile];
    std::size_t block = first_[tile];
    while (block + block_size != end.link) {
      const std::size_t next = pool_[block + block_size].bits();
      prefetch_block(next);
      visit(&pool_[block], block_size);
      block = next;
    }
    visit(&pool_[block], end.next - block);
  }

 private:
  static constexpr std::size_t none = SIZE_MAX;
  static constexpr std::size_t stride = 64;              ///< samples from block to block
  static constexpr std::size_t block_size = stride - 1;  ///< one is the link to the next block
  static constexpr std::size_t blocks_ahead = 4;         ///< are fetched before they are written
  static constexpr std::size_t samples_per_line = 8;
  struct End {
    std::size_t next = 0;  ///< where the tile's next sample goes ...
    std::size_t link = 0;  ///< ... unless it is here, where the link goes
  };

  void append_block(std::size_t tile) {
    End& end = ends_[tile];
    if (first_[tile] == none)
      first_[tile] = used_;
    else
      pool_[end.link] = Sample(used_);
    end = {used_, used_ + block_size};
    used_ += stride;
    const Sample* const soon = &pool_[used_ + (blocks_ahead - 1) * stride];
    for (std::size_t i = 0; i < stride; i += samples_per_line) __builtin_prefetch(soon + i, 1);
  }
  void prefetch_block(std::size_t block) const {
    for (std::size_t i = 0; i < block_size; i += samples_per_line) __builtin_prefetch(&pool_[block + i]);
  }

  std::vector<End> ends_;
  std::vector<std::size_t> first_;
  std::unique_ptr<Sample[]> pool_;
  std::size_t room_ = 0;
  std::size_t used_ = 0;
};

}  // namespace aeolian
