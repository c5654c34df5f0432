#pragma once

#include "aeolian_core/grains/impacts/bed_packing.hpp"

namespace aeolian {

/// Measures a bed of grains of this mean radius over a floor at height zero [m].
template <int Dim>
BedState bed_state(const GrainDynamics<Dim>& grains, const BedSurface& surface, double radius, double length,
                   double width);

extern template BedState bed_state(const GrainDynamics<2>&, const BedSurface&, double, double, double);
extern template BedState bed_state(const GrainDynamics<3>&, const BedSurface&, double, double, double);

}  // namespace aeolian
