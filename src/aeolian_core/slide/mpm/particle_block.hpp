#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "aeolian_core/slide/mpm/symmetric.hpp"

namespace aeolian {

/// Blocks are 4^d cells of the background grid, the unit of storage, of work and of sleep.
constexpr int block_cells = 4;
/// A block's particles reach these nodes a side: its own, one on each side that they may drift before they
/// are handed on, and two more of the stencil.
constexpr int reach_nodes = block_cells + 4;

template <int Dim>
constexpr int power(int base) {
  return Dim == 2 ? base * base : base * base * base;
}
template <int Dim>
constexpr int neighbours = power<Dim>(3);  ///< of a block, itself among them

/// Where a block is, in blocks from the origin.
template <int Dim>
using BlockPlace = std::array<int, static_cast<std::size_t>(Dim)>;

/// The neighbour of a block with a number from 0 to 3^d, x fastest; the block itself is in the middle.
template <int Dim>
BlockPlace<Dim> neighbour(BlockPlace<Dim> place, int number) {
  for (int d = 0; d < Dim; ++d) {
    place[static_cast<std::size_t>(d)] += number % 3 - 1;
    number /= 3;
  }
  return place;
}

/// Four particles. Lanes without a particle have no mass and the id -1.
template <int Dim>
struct alignas(sizeof(Lanes)) Pack {
  Lanes place[Dim];                ///< [m]
  Lanes velocity[Dim];             ///< [m/s]
  Lanes affine[Dim][Dim];          ///< C of APIC, velocity gradient [row][column] [1/s]
  Lanes b[symmetric_size<Dim>];    ///< elastic left Cauchy-Green tensor
  Lanes tau[symmetric_size<Dim>];  ///< Kirchhoff stress [Pa]
  Lanes alpha;                     ///< compaction, see flow_and_stress
  Lanes mass;                      ///< [kg], in two dimensions per metre of width
  Lanes volume;                    ///< at the beginning [m^d]
  std::array<int, lane_count> id;
};

/// A vector for each of the nodes that a block reaches, x fastest.
template <int Dim>
struct alignas(sizeof(Lanes)) ReachedNodes {
  static constexpr int size = power<Dim>(reach_nodes);
  Lanes at[size];
};

/// What a block's particles bring to the nodes that they reach: momentum and, in the last lane, mass; for
/// FLIP their forces beside it.
template <int Dim>
struct NodeSums {
  std::unique_ptr<ReachedNodes<Dim>> momentum;
  std::unique_ptr<ReachedNodes<Dim>> force;  ///< null unless FLIP
};

/// The particles of a block.
template <int Dim>
struct ParticleBlock {
  BlockPlace<Dim> place;
  std::vector<Pack<Dim>> packs;
  int count = 0;  ///< of particles
  NodeSums<Dim> sums;
  std::array<int, neighbours<Dim>> nodes;  ///< node blocks about it
  double fastest = 0;                      ///< particle [m/s]
  double strain = 0;                       ///< largest element of dt grad v in the last step
  double calm = 0;                         ///< how long it has been at rest [s]
  bool asleep = false;
};

/// What a step asks of the transfers.
struct TransferStep {
  double dt = 0;        ///< [s]
  double cell = 0;      ///< [m]
  double blend = 0.99;  ///< share of FLIP, unused by APIC
};

}  // namespace aeolian
