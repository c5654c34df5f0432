#pragma once

#include "aeolian_core/slide/mpm/block_index.hpp"
#include "aeolian_core/slide/mpm/node_block.hpp"
#include "aeolian_core/slide/mpm/pack_store.hpp"

namespace aeolian {

/// The blocks of particles and of nodes that exist, how they touch, and which of them take part in a step.
template <int Dim>
class BlockGrid {
 public:
  BlockGrid(double cell, std::vector<Obstacle<Dim>> obstacles)
      : cell_(cell), obstacles_(std::move(obstacles)) {}

  /// Hands particles over to the blocks that they are in: those in `newcomers`, and those that have left
  /// theirs among the blocks that are awake. Wakes the blocks that get one.
  void hand_over(std::vector<Passenger<Dim>> newcomers);
  /// Lists anew who takes part, after blocks have fallen asleep or woken.
  void list_awake();

  const std::vector<Obstacle<Dim>>& obstacles() const { return obstacles_; }
  std::vector<ParticleBlock<Dim>>& particles() { return particles_; }
  const std::vector<ParticleBlock<Dim>>& particles() const { return particles_; }
  std::vector<NodeBlock<Dim>>& nodes() { return nodes_; }
  const std::vector<int>& awake() const { return awake_; }  ///< particle blocks
  const std::vector<int>& live() const { return live_; }    ///< node blocks that one of those reaches
  const std::vector<int>& border() const {
    return border_;
  }  ///< particle blocks asleep that reach such nodes
  bool is_live(int nodes) const { return live_flags_[static_cast<std::size_t>(nodes)] != 0; }

 private:
  void link();

  double cell_;
  std::vector<Obstacle<Dim>> obstacles_;
  std::vector<ParticleBlock<Dim>> particles_;
  std::vector<NodeBlock<Dim>> nodes_;
  BlockIndex<Dim> particle_index_, node_index_;
  std::vector<int> awake_, live_, border_;
  std::vector<char> live_flags_;
};

extern template class BlockGrid<2>;
extern template class BlockGrid<3>;

}  // namespace aeolian
