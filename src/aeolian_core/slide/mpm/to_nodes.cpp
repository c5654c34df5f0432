#include "aeolian_core/slide/mpm/stencil.hpp"
#include "aeolian_core/slide/mpm/transfer.hpp"

namespace aeolian {
namespace {

/// A linear function of the node for each of four particles, as node vectors: value at the first node and
/// increments from node to node.
template <int Dim>
struct NodeRamp {
  Lanes first[lane_count];
  Lanes along[Dim][lane_count];
};

/// Rows (components, mass) of four particles to one node vector a particle.
AEOLIAN_INLINE void to_particles(Lanes rows[4], Lanes vectors[lane_count]) {
  transpose(rows[0], rows[1], rows[2], rows[3]);
  for (int lane = 0; lane < lane_count; ++lane) vectors[lane] = rows[lane];
}

/// Momentum m (v + C (x_i - x_p)), less the stress' impulse dt V0 4 / h^2 tau (x_i - x_p).
template <int Dim>
AEOLIAN_INLINE NodeRamp<Dim> affine_ramp(const Pack<Dim>& pack, const Stencil<Dim>& stencil,
                                         const TransferStep& step) {
  const Lanes impulse = pack.volume * (4 * step.dt / (step.cell * step.cell));
  NodeRamp<Dim> ramp;
  Lanes first[4], column[Dim][4];
  for (int k = 0; k < 4; ++k) first[k] = constant<Lanes>(0);
  for (int row = 0; row < Dim; ++row) {
    first[row] = pack.mass * pack.velocity[row];
    for (int c = 0; c < Dim; ++c) {
      const Lanes a = pack.mass * pack.affine[row][c] - impulse * pack.tau[symmetric_index<Dim>(row, c)];
      first[row] += a * stencil.offset[c];
      column[c][row] = a * step.cell;
    }
  }
  first[3] = pack.mass;
  to_particles(first, ramp.first);
  for (int c = 0; c < Dim; ++c) {
    for (int row = Dim; row < 4; ++row) column[c][row] = constant<Lanes>(0);
    to_particles(column[c], ramp.along[c]);
  }
  return ramp;
}

AEOLIAN_INLINE void add_ramp(const NodeRamp<2>& ramp, const Stencil<2>& s, int lane, Lanes* nodes) {
  for (int j = 0; j < 3; ++j) {
    Lanes* const row = nodes + j * reach_nodes;
    const Lanes start =
        s.weight[1][j][lane] * (ramp.first[lane] + static_cast<double>(j) * ramp.along[1][lane]);
    const Lanes step = s.weight[1][j][lane] * ramp.along[0][lane];
    row[0] += s.weight[0][0][lane] * start;
    row[1] += s.weight[0][1][lane] * (start + step);
    row[2] += s.weight[0][2][lane] * (start + 2.0 * step);
  }
}

AEOLIAN_INLINE void add_ramp(const NodeRamp<3>& ramp, const Stencil<3>& s, int lane, Lanes* nodes) {
  for (int k = 0; k < 3; ++k) {
    const Lanes plane = ramp.first[lane] + static_cast<double>(k) * ramp.along[2][lane];
    for (int j = 0; j < 3; ++j) {
      Lanes* const row = nodes + (k * reach_nodes + j) * reach_nodes;
      const double weight = s.weight[2][k][lane] * s.weight[1][j][lane];
      const Lanes start = weight * (plane + static_cast<double>(j) * ramp.along[1][lane]);
      const Lanes step = weight * ramp.along[0][lane];
      row[0] += s.weight[0][0][lane] * start;
      row[1] += s.weight[0][1][lane] * (start + step);
      row[2] += s.weight[0][2][lane] * (start + 2.0 * step);
    }
  }
}

/// Calls add(node offset, indices along the axes) for the nodes of a stencil.
template <int Dim, class Add>
AEOLIAN_INLINE void for_stencil(Add add) {
  for (int k = 0; k < (Dim == 3 ? 3 : 1); ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int at[3] = {i, j, k};
        add((k * reach_nodes + j) * reach_nodes + i, at);
      }
}

/// Momentum m v and force -V0 tau grad w.
template <int Dim>
AEOLIAN_INLINE void add_flip(const Pack<Dim>& pack, const Stencil<Dim>& s, Lanes* momentum, Lanes* force) {
  Lanes rows[4], carried[lane_count];
  for (int k = 0; k < 4; ++k) rows[k] = constant<Lanes>(0);
  for (int row = 0; row < Dim; ++row) rows[row] = pack.mass * pack.velocity[row];
  rows[3] = pack.mass;
  to_particles(rows, carried);
  Lanes stress[Dim][lane_count];
  for (int c = 0; c < Dim; ++c) {
    for (int k = 0; k < 4; ++k) rows[k] = constant<Lanes>(0);
    for (int row = 0; row < Dim; ++row) rows[row] = -(pack.volume * pack.tau[symmetric_index<Dim>(row, c)]);
    to_particles(rows, stress[c]);
  }
  for (int lane = 0; lane < lane_count; ++lane) {
    const int base = s.base[lane];
    for_stencil<Dim>([&](int node, const int* at) {
      double weight = 1;
      for (int d = 0; d < Dim; ++d) weight *= s.weight[d][at[d]][lane];
      momentum[base + node] += weight * carried[lane];
      for (int c = 0; c < Dim; ++c) {
        double slope = 1;
        for (int d = 0; d < Dim; ++d) slope *= (d == c ? s.slope[d] : s.weight[d])[at[d]][lane];
        force[base + node] += slope * stress[c][lane];
      }
    });
  }
}

template <int Dim, bool flip>
AEOLIAN_INLINE void add_particles(ParticleBlock<Dim>& block, const TransferStep& step) {
  constexpr int nodes = ReachedNodes<Dim>::size;
  Lanes* const momentum = block.sums.momentum->at;
  Lanes* const force = flip ? block.sums.force->at : nullptr;
  for (int k = 0; k < nodes; ++k) momentum[k] = constant<Lanes>(0);
  if constexpr (flip)
    for (int k = 0; k < nodes; ++k) force[k] = constant<Lanes>(0);
  int corner[Dim];
  corner_of<Dim>(block.place, corner);
  for (const Pack<Dim>& pack : block.packs) {
    const Stencil<Dim> stencil(pack.place, corner, step.cell);
    if constexpr (flip) {
      add_flip<Dim>(pack, stencil, momentum, force);
    } else {
      const NodeRamp<Dim> ramp = affine_ramp<Dim>(pack, stencil, step);
      for (int lane = 0; lane < lane_count; ++lane)
        add_ramp(ramp, stencil, lane, momentum + stencil.base[lane]);
    }
  }
}

AEOLIAN_KERNEL void apic_2d(ParticleBlock<2>& block, const TransferStep& step) {
  add_particles<2, false>(block, step);
}
AEOLIAN_KERNEL void apic_3d(ParticleBlock<3>& block, const TransferStep& step) {
  add_particles<3, false>(block, step);
}
AEOLIAN_KERNEL void flip_2d(ParticleBlock<2>& block, const TransferStep& step) {
  add_particles<2, true>(block, step);
}
AEOLIAN_KERNEL void flip_3d(ParticleBlock<3>& block, const TransferStep& step) {
  add_particles<3, true>(block, step);
}

template <int Dim>
void make_room(NodeSums<Dim>& sums, bool flip) {
  if (!sums.momentum) sums.momentum = std::make_unique<ReachedNodes<Dim>>();
  if (flip && !sums.force) sums.force = std::make_unique<ReachedNodes<Dim>>();
}

}  // namespace

template <>
void to_nodes(ParticleBlock<2>& block, const TransferStep& step, Transfer transfer) {
  make_room(block.sums, transfer == Transfer::flip);
  transfer == Transfer::flip ? flip_2d(block, step) : apic_2d(block, step);
}
template <>
void to_nodes(ParticleBlock<3>& block, const TransferStep& step, Transfer transfer) {
  make_room(block.sums, transfer == Transfer::flip);
  transfer == Transfer::flip ? flip_3d(block, step) : apic_3d(block, step);
}

}  // namespace aeolian
