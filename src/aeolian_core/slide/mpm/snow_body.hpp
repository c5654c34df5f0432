#pragma once

#include "aeolian_core/slide/mpm/material_points.hpp"

namespace aeolian {

/// A box filled with particles.
template <int Dim>
struct SnowBox {
  Point<Dim> corner = Point<Dim>::Zero();  ///< [m]
  Eigen::Matrix<double, Dim, Dim> axes =
      Eigen::Matrix<double, Dim, Dim>::Identity();  ///< orthonormal columns
  Point<Dim> size = Point<Dim>::Ones();             ///< along the axes [m]
};

/// Fresh snow at rest: at least so many particles in the volume of a cell, on a lattice along the box's axes,
/// each moved by up to `jitter` of its spacing at random (its own stream of the seed). Their mass is exactly
/// density times volume. Throws Error for a box without volume.
template <int Dim>
std::vector<MaterialPoint<Dim>> filled_box(const SnowBox<Dim>& box, const SnowLaw& law, double cell,
                                           double particles_per_cell, double jitter = 0,
                                           std::uint64_t seed = 0);

extern template std::vector<MaterialPoint<2>> filled_box(const SnowBox<2>&, const SnowLaw&, double, double,
                                                         double, std::uint64_t);
extern template std::vector<MaterialPoint<3>> filled_box(const SnowBox<3>&, const SnowLaw&, double, double,
                                                         double, std::uint64_t);

}  // namespace aeolian
