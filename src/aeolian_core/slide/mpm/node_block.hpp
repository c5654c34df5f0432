#pragma once

#include "aeolian_core/slide/mpm/obstacle.hpp"
#include "aeolian_core/slide/mpm/particle_block.hpp"
#include "aeolian_core/slide/mpm/transfer.hpp"

namespace aeolian {

/// The nodes of a block: velocities at the end of a step.
template <int Dim>
struct alignas(sizeof(Lanes)) NodeBlock {
  static constexpr int size = power<Dim>(block_cells);
  /// A node inside an obstacle.
  struct Touch {
    int node;
    int obstacle;
    Point<Dim> normal;
  };

  BlockPlace<Dim> place;
  std::array<int, neighbours<Dim>> particles;  ///< particle blocks about it, -1 where there is none
  std::array<Lanes, size> velocity;            ///< the last lane is 0 [m/s]
  std::array<Lanes, size> before;              ///< forces and contact; FLIP only
  std::vector<Touch> touches;
};

/// Finds the nodes that are inside of obstacles.
template <int Dim>
void find_touches(NodeBlock<Dim>& block, const std::vector<Obstacle<Dim>>& obstacles, double cell);

/// Adds up, in a fixed order, what the particle blocks about it bring, and takes the step: forces, gravity
/// [m/s^2], contact. Nodes of less mass than `least` [kg] stay at rest.
template <int Dim>
void update_nodes(NodeBlock<Dim>& block, const std::vector<ParticleBlock<Dim>>& particles,
                  const std::vector<Obstacle<Dim>>& obstacles, const Point<Dim>& gravity, double dt,
                  double least, Transfer transfer);

/// Node velocities that a particle block reaches, from the node blocks about it.
template <int Dim>
void collect_velocities(const ParticleBlock<Dim>& block, const std::vector<NodeBlock<Dim>>& nodes,
                        std::array<Lanes, NodeBlock<Dim>::size> NodeBlock<Dim>::*which,
                        ReachedNodes<Dim>& collected);

}  // namespace aeolian
