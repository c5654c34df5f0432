#pragma once

#include <cstdint>

#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/grains/impacts/bed_surface.hpp"

namespace aeolian {

/// How a bed of grains is laid.
struct BedRecipe {
  enum class Packing {
    loose,   ///< discs: a jittered, almost square lattice that has collapsed (Werner 1987, ch. III)
    dense,   ///< discs: hexagonal rows and a plateau of two thirds of a row, whose ends are a brink and an
             ///< anti-brink (Werner 1987, ch. III)
    poured,  ///< rained down at random
    struck,  ///< poured, then struck off level with a straightedge, as experiments begin
  };
  Packing packing = Packing::loose;
  double radius = 0.01;  ///< mean [m]
  double size_spread =
      0;             ///< standard deviation of the radii over their mean, log-normal, cut at two; 0 to 0.5
  int grains = 375;  ///< laid; those struck off or taken out are missing from the bed
  double pits = 0;   ///< share of the surface's grains that are taken out at random, 0 to 0.5
  double length = 0.673;  ///< along the flight, between walls for discs, periodic for spheres [m]
  double width = 0;       ///< across the flight, periodic, spheres only [m]
  double calm = 1e-5;     ///< settled when the mean kinetic energy of a grain is below so many m g d
};

/// What can be said about a bed at rest.
struct BedState {
  int grains;
  double packing_fraction;  ///< between a diameter above the floor and one below the mean surface
  double coordination;      ///< contacts with other grains, mean over grains
  double kinetic_energy;    ///< mean of a grain, in m g d
  double overlap_energy;    ///< in all contacts' springs, mean over grains, in m g d
  double roughness;         ///< brinks per diameter along the flight
};

/// A settled bed.
template <int Dim>
struct Bed {
  GrainDynamics<Dim> grains;
  double radius;         ///< mean [m]
  double length, width;  ///< [m]
  BedSurface surface;
  BedState state;
};

/// Lays grains under the law, density and gravity of a world, lets them settle, and looks at the result.
/// The world's walls and periods are made here; its drag and sleep rule are those of the bed afterwards.
/// Throws Error naming the part of the recipe that is not valid, its value and what is allowed, and when the
/// bed does not come to rest.
template <int Dim>
Bed<Dim> make_bed(const BedRecipe& recipe, const GrainWorld<Dim>& world, std::uint64_t seed);

/// The bed that these grains are once they rest: state and surface anew.
template <int Dim>
Bed<Dim> settled_bed(GrainDynamics<Dim> grains, const BedRecipe& recipe);

extern template Bed<2> make_bed(const BedRecipe&, const GrainWorld<2>&, std::uint64_t);
extern template Bed<3> make_bed(const BedRecipe&, const GrainWorld<3>&, std::uint64_t);
extern template Bed<2> settled_bed(GrainDynamics<2>, const BedRecipe&);
extern template Bed<3> settled_bed(GrainDynamics<3>, const BedRecipe&);

}  // namespace aeolian
