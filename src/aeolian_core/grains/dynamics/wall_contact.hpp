#pragma once

#include "aeolian_core/grains/dynamics/contact_force.hpp"
#include "aeolian_core/grains/dynamics/grain_dynamics.hpp"
#include "aeolian_core/grains/dynamics/grain_record.hpp"

namespace aeolian {

/// A grain that is near a wall, and its shear spring.
template <int Dim>
struct WallContact {
  int grain, wall;
  double slip[slip_size<Dim>] = {};
};

template <int Dim>
bool operator<(const WallContact<Dim>& a, const WallContact<Dim>& b) {
  return a.grain != b.grain ? a.grain < b.grain : a.wall < b.wall;
}

/// Where a wall is nearest to a place.
template <int Dim>
struct NearestOfWall {
  Vector<Dim> normal;  ///< of unit length, from the wall
  double distance;     ///< [m]
};
NearestOfWall<2> nearest(const Wall<2>& wall, const Vector<2>& place);
NearestOfWall<3> nearest(const Wall<3>& wall, const Vector<3>& place);

/// Moves a wall on.
void move(Wall<2>& wall, double time);
void move(Wall<3>& wall, double time);

/// Whether grain and wall touch, and what they do to each other: the contact law with a wall of infinite mass
/// and size. The record's velocities are those half a step ago, as with pairs.
template <int Dim>
struct WallForce {
  bool touching = false;
  double overlap = 0, normal_force = 0;
  Vector<Dim> normal = Vector<Dim>::Zero(), shear = Vector<Dim>::Zero();
  GrainLoad<Dim> load;
};
template <int Dim>
WallForce<Dim> wall_force(const LawConstants& law, double dt, const Wall<Dim>& wall,
                          const GrainRecord<Dim>& grain, double* slip);

}  // namespace aeolian
