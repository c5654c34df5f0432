#pragma once

#include "aeolian_core/grains/dynamics/grain_record.hpp"

namespace aeolian {

/// A grain's place when it was last looked at, and how far from there it may go.
struct alignas(32) Anchor {
  double place[3] = {};
  double skin = -1;  ///< negative: never looked at [m]
};

/// The first half of a step for the grains in `slots`: half a kick, then on. Whether one of them has used up
/// its skin.
template <int Dim>
bool move_grains(GrainRecord<Dim>* grains, const Anchor* anchors, const int* slots, int count, double dt);

/// The second half of a step.
template <int Dim>
struct KickWork {
  GrainRecord<Dim>* grains;
  GrainLoad<Dim>* loads;  ///< of this instant; zero afterwards
  double* rest;           ///< how long each grain has been slow [s]
  double dt;
  double gravity[3];  ///< [m/s^2]
  double drag;        ///< [1/s]
  double slow;        ///< which speed that is, for the centre and for the surface [m/s]
};

/// Largest ones, squared.
struct Liveliest {
  double speed = 0, acceleration = 0;
};

template <int Dim>
void kick_grains(const KickWork<Dim>& work, const int* slots, int count, Liveliest& liveliest);

}  // namespace aeolian
