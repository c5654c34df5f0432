#include "aeolian_core/slide/mpm/node_block.hpp"

namespace aeolian {
namespace {

/// Nodes of a block, along one axis, that the block on one side of it reaches: from `first`, so many, the
/// first being number `local` of those that it reaches.
struct Overlap {
  int first, count, local;
};
constexpr Overlap overlap(int side) {
  return side < 0 ? Overlap{0, 3, 5} : side == 0 ? Overlap{0, block_cells, 1} : Overlap{3, 1, 0};
}

/// Calls each(node of the block, number among those that the neighbour reaches, length) for runs along x.
template <int Dim, class Each>
AEOLIAN_INLINE void for_overlap(int side, Each each) {
  const Overlap x = overlap(side % 3 - 1);
  const Overlap y = overlap(side / 3 % 3 - 1);
  const Overlap z = Dim == 3 ? overlap(side / 9 - 1) : Overlap{0, 1, 0};
  for (int k = 0; k < z.count; ++k)
    for (int j = 0; j < y.count; ++j)
      each(((z.first + k) * block_cells + y.first + j) * block_cells + x.first,
           ((z.local + k) * reach_nodes + y.local + j) * reach_nodes + x.local, x.count);
}

template <int Dim>
AEOLIAN_INLINE void add_up(const NodeBlock<Dim>& block, const std::vector<ParticleBlock<Dim>>& particles,
                           std::unique_ptr<ReachedNodes<Dim>> NodeSums<Dim>::*which, Lanes* sums) {
  for (int k = 0; k < NodeBlock<Dim>::size; ++k) sums[k] = constant<Lanes>(0);
  for (int side = 0; side < neighbours<Dim>; ++side) {
    const int number = block.particles[static_cast<std::size_t>(side)];
    if (number < 0) continue;
    const Lanes* const from = (particles[static_cast<std::size_t>(number)].sums.*which)->at;
    for_overlap<Dim>(side, [&](int node, int reached, int count) {
      for (int i = 0; i < count; ++i) sums[node + i] += from[reached + i];
    });
  }
}

template <int Dim>
AEOLIAN_INLINE void take_step(NodeBlock<Dim>& block, const std::vector<ParticleBlock<Dim>>& particles,
                              const Lanes& kick, double dt, double least, Transfer transfer) {
  Lanes momentum[NodeBlock<Dim>::size], force[NodeBlock<Dim>::size];
  add_up<Dim>(block, particles, &NodeSums<Dim>::momentum, momentum);
  const bool flip = transfer == Transfer::flip;
  if (flip) add_up<Dim>(block, particles, &NodeSums<Dim>::force, force);
  const Lanes components = {1, 1, Dim == 3 ? 1. : 0., 0};
  for (int k = 0; k < NodeBlock<Dim>::size; ++k) {
    const double mass = momentum[k][3];
    const auto n = static_cast<std::size_t>(k);
    if (!(mass > least)) {
      block.velocity[n] = constant<Lanes>(0);
      if (flip) block.before[n] = constant<Lanes>(0);
      continue;
    }
    Lanes velocity = momentum[k] * components / mass;
    if (flip) {
      block.before[n] = velocity;
      velocity += force[k] * (dt / mass);
    }
    block.velocity[n] = velocity + kick;
  }
}

AEOLIAN_KERNEL void take_step_2d(NodeBlock<2>& block, const std::vector<ParticleBlock<2>>& particles,
                                 const Lanes& kick, double dt, double least, Transfer transfer) {
  take_step<2>(block, particles, kick, dt, least, transfer);
}
AEOLIAN_KERNEL void take_step_3d(NodeBlock<3>& block, const std::vector<ParticleBlock<3>>& particles,
                                 const Lanes& kick, double dt, double least, Transfer transfer) {
  take_step<3>(block, particles, kick, dt, least, transfer);
}

template <int Dim>
void touch_obstacles(NodeBlock<Dim>& block, const std::vector<Obstacle<Dim>>& obstacles) {
  for (const auto& touch : block.touches) {
    Lanes& lanes = block.velocity[static_cast<std::size_t>(touch.node)];
    Point<Dim> velocity;
    for (int d = 0; d < Dim; ++d) velocity[d] = lanes[d];
    velocity =
        after_contact<Dim>(velocity, touch.normal, obstacles[static_cast<std::size_t>(touch.obstacle)]);
    for (int d = 0; d < Dim; ++d) lanes[d] = velocity[d];
  }
}

}  // namespace

template <int Dim>
void find_touches(NodeBlock<Dim>& block, const std::vector<Obstacle<Dim>>& obstacles, double cell) {
  block.touches.clear();
  Point<Dim> first;
  for (int d = 0; d < Dim; ++d) first[d] = block_cells * block.place[static_cast<std::size_t>(d)] * cell;
  const double half = 0.5 * (block_cells - 1) * cell;
  const Point<Dim> middle = first + Point<Dim>::Constant(half);
  for (std::size_t o = 0; o < obstacles.size(); ++o) {
    if (!obstacles[o].shape->may_touch(middle, std::sqrt(static_cast<double>(Dim)) * half)) continue;
    for (int node = 0; node < NodeBlock<Dim>::size; ++node) {
      Point<Dim> place = first;
      int rest = node;
      for (int d = 0; d < Dim; ++d) {
        place[d] += rest % block_cells * cell;
        rest /= block_cells;
      }
      const Nearness<Dim> near = obstacles[o].shape->at(place);
      if (near.distance <= 0) block.touches.push_back({node, static_cast<int>(o), near.normal});
    }
  }
}

template <int Dim>
void update_nodes(NodeBlock<Dim>& block, const std::vector<ParticleBlock<Dim>>& particles,
                  const std::vector<Obstacle<Dim>>& obstacles, const Point<Dim>& gravity, double dt,
                  double least, Transfer transfer) {
  alignas(sizeof(Lanes)) Lanes kick = constant<Lanes>(0);
  for (int d = 0; d < Dim; ++d) kick[d] = dt * gravity[d];
  if constexpr (Dim == 2)
    take_step_2d(block, particles, kick, dt, least, transfer);
  else
    take_step_3d(block, particles, kick, dt, least, transfer);
  touch_obstacles(block, obstacles);
}

template <int Dim>
void collect_velocities(const ParticleBlock<Dim>& block, const std::vector<NodeBlock<Dim>>& nodes,
                        std::array<Lanes, NodeBlock<Dim>::size> NodeBlock<Dim>::*which,
                        ReachedNodes<Dim>& collected) {
  for (int side = 0; side < neighbours<Dim>; ++side) {
    // Seen from the node block, the particle block is on the other side.
    const Lanes* const from =
        (nodes[static_cast<std::size_t>(block.nodes[static_cast<std::size_t>(side)])].*which).data();
    for_overlap<Dim>(neighbours<Dim> - 1 - side, [&](int node, int reached, int count) {
      for (int i = 0; i < count; ++i) collected.at[reached + i] = from[node + i];
    });
  }
}

template void find_touches(NodeBlock<2>&, const std::vector<Obstacle<2>>&, double);
template void find_touches(NodeBlock<3>&, const std::vector<Obstacle<3>>&, double);
template void update_nodes(NodeBlock<2>&, const std::vector<ParticleBlock<2>>&,
                           const std::vector<Obstacle<2>>&, const Point<2>&, double, double, Transfer);
template void update_nodes(NodeBlock<3>&, const std::vector<ParticleBlock<3>>&,
                           const std::vector<Obstacle<3>>&, const Point<3>&, double, double, Transfer);
template void collect_velocities(const ParticleBlock<2>&, const std::vector<NodeBlock<2>>&,
                                 std::array<Lanes, NodeBlock<2>::size> NodeBlock<2>::*, ReachedNodes<2>&);
template void collect_velocities(const ParticleBlock<3>&, const std::vector<NodeBlock<3>>&,
                                 std::array<Lanes, NodeBlock<3>::size> NodeBlock<3>::*, ReachedNodes<3>&);

}  // namespace aeolian
