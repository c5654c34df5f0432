#pragma once

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"

namespace aeolian {

/// Throws Error naming what is not valid, its value and what is allowed.
template <int Dim>
void require_valid(const GrainWorld<Dim>& world);

/// Throws Error for a grain that no such world can hold.
template <int Dim>
void require_valid_grain(const GrainWorld<Dim>& world, const Vector<Dim>& position, double radius,
                         const Vector<Dim>& velocity, const Spin<Dim>& spin);

}  // namespace aeolian
