#include "aeolian_core/slide/mpm/block_grid.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

template <int Dim>
void BlockGrid<Dim>::hand_over(std::vector<Passenger<Dim>> newcomers) {
  for (ParticleBlock<Dim>& block : particles_)
    if (!block.asleep) take_leavers(block, cell_, newcomers);
  bool changed = false;
  const double farthest = (BlockIndex<Dim>::farthest - 2) * block_cells * cell_;
  for (const Passenger<Dim>& passenger : newcomers) {
    for (std::size_t d = 0; d < Dim; ++d)
      if (!(std::abs(passenger.values[d]) < farthest))
        throw Error(
            fmt::format("snow: a particle is at {:g} m along axis {}, must stay within {:g} m of the origin",
                        passenger.values[d], d, farthest));
    const BlockPlace<Dim> home = home_of(passenger, cell_);
    const auto number =
        static_cast<std::size_t>(particle_index_.find_or_set(home, static_cast<int>(particles_.size())));
    if (number == particles_.size()) {
      particles_.emplace_back();
      particles_.back().place = home;
      changed = true;
    }
    ParticleBlock<Dim>& block = particles_[number];
    board(block, passenger, cell_);
    block.asleep = false;
    block.calm = 0;
  }
  const auto empty = std::stable_partition(particles_.begin(), particles_.end(),
                                           [](const ParticleBlock<Dim>& block) { return block.count > 0; });
  changed = changed || empty != particles_.end();
  particles_.erase(empty, particles_.end());
  if (changed) link();
  list_awake();
}

template <int Dim>
void BlockGrid<Dim>::link() {
  particle_index_.clear();
  for (std::size_t k = 0; k < particles_.size(); ++k)
    particle_index_.set(particles_[k].place, static_cast<int>(k));
  std::vector<NodeBlock<Dim>> old;
  old.swap(nodes_);
  BlockIndex<Dim> old_index;
  std::swap(old_index, node_index_);
  for (ParticleBlock<Dim>& block : particles_)
    for (int side = 0; side < neighbours<Dim>; ++side) {
      const BlockPlace<Dim> place = neighbour<Dim>(block.place, side);
      const int number = node_index_.find_or_set(place, static_cast<int>(nodes_.size()));
      block.nodes[static_cast<std::size_t>(side)] = number;
      if (static_cast<std::size_t>(number) < nodes_.size()) continue;
      const int known = old_index.find(place);
      if (known >= 0) {
        nodes_.push_back(std::move(old[static_cast<std::size_t>(known)]));
      } else {
        nodes_.emplace_back();
        nodes_.back().place = place;
        find_touches(nodes_.back(), obstacles_, cell_);
      }
    }
  for (NodeBlock<Dim>& block : nodes_)
    for (int side = 0; side < neighbours<Dim>; ++side)
      block.particles[static_cast<std::size_t>(side)] =
          particle_index_.find(neighbour<Dim>(block.place, side));
}

template <int Dim>
void BlockGrid<Dim>::list_awake() {
  awake_.clear();
  border_.clear();
  live_.clear();
  live_flags_.assign(nodes_.size(), 0);
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    if (particles_[k].asleep) continue;
    awake_.push_back(static_cast<int>(k));
    for (const int n : particles_[k].nodes) live_flags_[static_cast<std::size_t>(n)] = 1;
  }
  for (std::size_t n = 0; n < nodes_.size(); ++n)
    if (live_flags_[n]) live_.push_back(static_cast<int>(n));
  for (std::size_t k = 0; k < particles_.size(); ++k) {
    const ParticleBlock<Dim>& block = particles_[k];
    if (block.asleep &&
        std::any_of(block.nodes.begin(), block.nodes.end(), [&](int n) { return is_live(n); }))
      border_.push_back(static_cast<int>(k));
  }
}

template class BlockGrid<2>;
template class BlockGrid<3>;

}  // namespace aeolian
