#pragma once

#include <cstddef>

#include "aeolian_core/slide/mpm/material_points.hpp"

namespace aeolian {

/// One lane of a pack on its way to another.
template <int Dim>
struct Passenger {
  static constexpr std::size_t rows = offsetof(Pack<Dim>, id) / sizeof(Lanes);
  std::array<double, rows> values;
  int id;
};

template <int Dim>
Passenger<Dim> take_lane(const Pack<Dim>& pack, int lane);
template <int Dim>
void put_lane(Pack<Dim>& pack, int lane, const Passenger<Dim>& passenger);

template <int Dim>
Passenger<Dim> passenger_of(const MaterialPoint<Dim>& point, int id);
template <int Dim>
MaterialPoint<Dim> point_of(const Passenger<Dim>& passenger);

/// The block of the first node of a particle's stencil.
template <int Dim>
BlockPlace<Dim> home_of(const Passenger<Dim>& passenger, double cell);

/// Appends a particle to a block.
template <int Dim>
void board(ParticleBlock<Dim>& block, const Passenger<Dim>& passenger, double cell);

/// Takes out the particles whose home is another block, moves the others together, and fills up the last pack
/// with lanes without mass. Appends them to `leavers` in their order.
template <int Dim>
void take_leavers(ParticleBlock<Dim>& block, double cell, std::vector<Passenger<Dim>>& leavers);

}  // namespace aeolian
