#include "aeolian_core/slide/mpm/stencil.hpp"
#include "aeolian_core/slide/mpm/transfer.hpp"

namespace aeolian {
namespace {

/// Velocity and sum of w v (x_i - x_p)^T of one particle, as node vectors.
template <int Dim>
struct Gathered {
  Lanes velocity;
  Lanes spread[Dim];
};

AEOLIAN_INLINE Gathered<2> gather(const Stencil<2>& s, int lane, double cell, const Lanes* nodes) {
  Gathered<2> sum{constant<Lanes>(0), {constant<Lanes>(0), constant<Lanes>(0)}};
  const double x0 = s.offset[0][lane], y0 = s.offset[1][lane];
  for (int j = 0; j < 3; ++j) {
    const Lanes* const row = nodes + j * reach_nodes;
    const Lanes a = s.weight[0][0][lane] * row[0];
    const Lanes b = s.weight[0][1][lane] * row[1];
    const Lanes c = s.weight[0][2][lane] * row[2];
    const Lanes all = s.weight[1][j][lane] * (a + b + c);
    const Lanes further = s.weight[1][j][lane] * (b + 2.0 * c);
    sum.velocity += all;
    sum.spread[0] += x0 * all + cell * further;
    sum.spread[1] += (y0 + j * cell) * all;
  }
  return sum;
}

AEOLIAN_INLINE Gathered<3> gather(const Stencil<3>& s, int lane, double cell, const Lanes* nodes) {
  Gathered<3> sum{constant<Lanes>(0), {constant<Lanes>(0), constant<Lanes>(0), constant<Lanes>(0)}};
  const double x0 = s.offset[0][lane], y0 = s.offset[1][lane], z0 = s.offset[2][lane];
  Lanes further = constant<Lanes>(0);
  for (int k = 0; k < 3; ++k) {
    Lanes plane = constant<Lanes>(0);
    for (int j = 0; j < 3; ++j) {
      const Lanes* const row = nodes + (k * reach_nodes + j) * reach_nodes;
      const double weight = s.weight[2][k][lane] * s.weight[1][j][lane];
      const Lanes b = s.weight[0][1][lane] * row[1];
      const Lanes c = s.weight[0][2][lane] * row[2];
      const Lanes all = weight * (s.weight[0][0][lane] * row[0] + b + c);
      further += weight * (b + 2.0 * c);
      sum.spread[1] += (y0 + j * cell) * all;
      plane += all;
    }
    sum.velocity += plane;
    sum.spread[2] += (z0 + k * cell) * plane;
  }
  sum.spread[0] = x0 * sum.velocity + cell * further;
  return sum;
}

/// Velocity, and gradient by the derivatives of the weights.
template <int Dim>
AEOLIAN_INLINE Gathered<Dim> gather_gradient(const Stencil<Dim>& s, int lane, const Lanes* nodes) {
  Gathered<Dim> sum;
  sum.velocity = constant<Lanes>(0);
  for (int c = 0; c < Dim; ++c) sum.spread[c] = constant<Lanes>(0);
  for (int k = 0; k < (Dim == 3 ? 3 : 1); ++k)
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        const int at[3] = {i, j, k};
        const Lanes v = nodes[(k * reach_nodes + j) * reach_nodes + i];
        double weight = 1;
        for (int d = 0; d < Dim; ++d) weight *= s.weight[d][at[d]][lane];
        sum.velocity += weight * v;
        for (int c = 0; c < Dim; ++c) {
          double slope = 1;
          for (int d = 0; d < Dim; ++d) slope *= (d == c ? s.slope[d] : s.weight[d])[at[d]][lane];
          sum.spread[c] += slope * v;
        }
      }
  return sum;
}

/// Node vectors of four particles to rows, one a component.
AEOLIAN_INLINE void to_rows(Lanes vectors[lane_count]) {
  transpose(vectors[0], vectors[1], vectors[2], vectors[3]);
}

/// b <- (1 + dt L) b (1 + dt L)^T; gives the largest element of dt L.
template <int Dim>
AEOLIAN_INLINE Lanes strain(Lanes b[symmetric_size<Dim>], const Lanes gradient[Dim][Dim], double dt) {
  Lanes f[Dim][Dim];
  Lanes most = constant<Lanes>(0);
  for (int r = 0; r < Dim; ++r)
    for (int c = 0; c < Dim; ++c) {
      f[r][c] = dt * gradient[r][c];
      most = larger(most, size_of(f[r][c]));
      if (r == c) f[r][c] += 1.0;
    }
  Lanes fb[Dim][Dim];
  for (int r = 0; r < Dim; ++r)
    for (int c = 0; c < Dim; ++c) {
      fb[r][c] = constant<Lanes>(0);
      for (int k = 0; k < Dim; ++k) fb[r][c] += f[r][k] * b[symmetric_index<Dim>(k, c)];
    }
  for (int r = 0; r < Dim; ++r)
    for (int c = r; c < Dim; ++c) {
      Lanes sum = constant<Lanes>(0);
      for (int k = 0; k < Dim; ++k) sum += fb[r][k] * f[c][k];
      b[symmetric_index<Dim>(r, c)] = sum;
    }
  return most;
}

template <int Dim, bool flip>
AEOLIAN_INLINE void move_particles(ParticleBlock<Dim>& block, const Lanes* velocity, const Lanes* before,
                                   const YieldConstants& law, const TransferStep& step) {
  int corner[Dim];
  corner_of<Dim>(block.place, corner);
  Lanes fastest = constant<Lanes>(0);
  Lanes most = constant<Lanes>(0);
  for (Pack<Dim>& pack : block.packs) {
    const Stencil<Dim> stencil(pack.place, corner, step.cell);
    Lanes moved[4], spread[Dim][4], old[4];
    for (int lane = 0; lane < lane_count; ++lane) {
      Gathered<Dim> sum;
      if constexpr (flip) {
        sum = gather_gradient<Dim>(stencil, lane, velocity + stencil.base[lane]);
        old[lane] = gather(stencil, lane, step.cell, before + stencil.base[lane]).velocity;
      } else {
        sum = gather(stencil, lane, step.cell, velocity + stencil.base[lane]);
      }
      moved[lane] = sum.velocity;
      for (int c = 0; c < Dim; ++c) spread[c][lane] = sum.spread[c];
    }
    to_rows(moved);
    if constexpr (flip) to_rows(old);
    const double to_gradient = flip ? 1 : 4 / (step.cell * step.cell);
    for (int c = 0; c < Dim; ++c) {
      to_rows(spread[c]);
      for (int r = 0; r < Dim; ++r) pack.affine[r][c] = to_gradient * spread[c][r];
    }
    Lanes speed = constant<Lanes>(0);
    const auto there = pack.mass > 0.0;
    for (int d = 0; d < Dim; ++d) {
      pack.place[d] += there ? step.dt * moved[d] : constant<Lanes>(0);
      if constexpr (flip)
        pack.velocity[d] =
            step.blend * (pack.velocity[d] + (moved[d] - old[d])) + (1 - step.blend) * moved[d];
      else
        pack.velocity[d] = moved[d];
      speed += moved[d] * moved[d];
    }
    fastest = larger(fastest, there ? speed : constant<Lanes>(0));
    constexpr double beyond_all = 1e30;  // also what is no number counts as this
    const Lanes strained = strain<Dim>(pack.b, pack.affine, step.dt);
    const Lanes told = strained + speed < beyond_all ? strained : constant<Lanes>(beyond_all);
    most = larger(most, there ? told : constant<Lanes>(0));
    flow_and_stress<Dim, Lanes>(law, pack.b, pack.alpha, pack.tau);
  }
  block.fastest = 0;
  block.strain = 0;
  for (int lane = 0; lane < lane_count; ++lane) {
    block.fastest = larger(block.fastest, fastest[lane]);
    block.strain = larger(block.strain, most[lane]);
  }
  block.fastest = square_root(block.fastest);
}

AEOLIAN_KERNEL void apic_2d(ParticleBlock<2>& block, const Lanes* velocity, const YieldConstants& law,
                            const TransferStep& step) {
  move_particles<2, false>(block, velocity, nullptr, law, step);
}
AEOLIAN_KERNEL void apic_3d(ParticleBlock<3>& block, const Lanes* velocity, const YieldConstants& law,
                            const TransferStep& step) {
  move_particles<3, false>(block, velocity, nullptr, law, step);
}
AEOLIAN_KERNEL void flip_2d(ParticleBlock<2>& block, const Lanes* velocity, const Lanes* before,
                            const YieldConstants& law, const TransferStep& step) {
  move_particles<2, true>(block, velocity, before, law, step);
}
AEOLIAN_KERNEL void flip_3d(ParticleBlock<3>& block, const Lanes* velocity, const Lanes* before,
                            const YieldConstants& law, const TransferStep& step) {
  move_particles<3, true>(block, velocity, before, law, step);
}

template <int Dim>
void refresh(ParticleBlock<Dim>& block, YieldConstants law) {
  law.yield = SnowLaw::Yield::none;
  for (Pack<Dim>& pack : block.packs) flow_and_stress<Dim, Lanes>(law, pack.b, pack.alpha, pack.tau);
}

}  // namespace

template <>
void from_nodes(ParticleBlock<2>& block, const ReachedNodes<2>& velocity, const ReachedNodes<2>& before,
                const YieldConstants& law, const TransferStep& step, Transfer transfer) {
  transfer == Transfer::flip ? flip_2d(block, velocity.at, before.at, law, step)
                             : apic_2d(block, velocity.at, law, step);
}
template <>
void from_nodes(ParticleBlock<3>& block, const ReachedNodes<3>& velocity, const ReachedNodes<3>& before,
                const YieldConstants& law, const TransferStep& step, Transfer transfer) {
  transfer == Transfer::flip ? flip_3d(block, velocity.at, before.at, law, step)
                             : apic_3d(block, velocity.at, law, step);
}
template <>
void refresh_stress(ParticleBlock<2>& block, const YieldConstants& law) {
  refresh(block, law);
}
template <>
void refresh_stress(ParticleBlock<3>& block, const YieldConstants& law) {
  refresh(block, law);
}

}  // namespace aeolian
