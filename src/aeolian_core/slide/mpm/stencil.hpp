#pragma once

#include "aeolian_core/slide/mpm/particle_block.hpp"

namespace aeolian {

/// Quadratic B-splines of four particles on the nodes that their block reaches (Frischholz 1.2.17-22). The
/// base is the first of three nodes along each axis, at x - base - 1/2 = f in [0, 1).
template <int Dim>
struct Stencil {
  /// `corner` is the block's first node that it reaches, in cells.
  AEOLIAN_INLINE Stencil(const Lanes place[Dim], const int corner[Dim], double cell) {
    using Ints = int __attribute__((vector_size(16)));
    const double inverse = 1 / cell;
    int stride = 1;
    Ints at = {0, 0, 0, 0};
    for (int d = 0; d < Dim; ++d) {
      const Lanes u = place[d] * inverse - (corner[d] + 0.5);
      const Ints whole = __builtin_convertvector(u, Ints);
      const Lanes f = u - __builtin_convertvector(whole, Lanes);
      offset[d] = (f + 0.5) * -cell;
      weight[d][0] = 0.5 * (1.0 - f) * (1.0 - f);
      weight[d][1] = 0.75 - (f - 0.5) * (f - 0.5);
      weight[d][2] = 0.5 * f * f;
      slope[d][0] = (f - 1.0) * inverse;
      slope[d][1] = (1.0 - 2.0 * f) * inverse;
      slope[d][2] = f * inverse;
      at += whole * stride;
      stride *= reach_nodes;
    }
    __builtin_memcpy(base, &at, sizeof base);
  }

  Lanes weight[Dim][3];
  Lanes slope[Dim][3];   ///< derivative of the weight [1/m]
  Lanes offset[Dim];     ///< first node minus particle [m]
  int base[lane_count];  ///< index of the first node
};

/// The first node that a block's particles reach, in cells.
template <int Dim>
AEOLIAN_INLINE void corner_of(const BlockPlace<Dim>& place, int corner[Dim]) {
  for (int d = 0; d < Dim; ++d) corner[d] = block_cells * place[static_cast<std::size_t>(d)] - 1;
}

}  // namespace aeolian
