#pragma once

#include <cmath>

#include "aeolian_core/grains/dynamics/contact_force.hpp"
#include "aeolian_core/grains/dynamics/grain_record.hpp"

namespace aeolian {

/// The velocity of a surface at a contact: `arms` is the sum of arm times spin over the bodies.
template <int Dim, class Real>
AEOLIAN_INLINE void add_turning(const Real* normal, const Real* arms, Real* velocity) {
  if constexpr (Dim == 2) {
    velocity[0] = velocity[0] + arms[0] * normal[1];
    velocity[1] = velocity[1] - arms[0] * normal[0];
  } else {
    velocity[0] = velocity[0] - (arms[1] * normal[2] - arms[2] * normal[1]);
    velocity[1] = velocity[1] - (arms[2] * normal[0] - arms[0] * normal[2]);
    velocity[2] = velocity[2] - (arms[0] * normal[1] - arms[1] * normal[0]);
  }
}

/// Torque per arm on a body whose surface, on the side that `normal` comes from, feels `shear`.
template <int Dim, class Real>
AEOLIAN_INLINE void twist(const Real* normal, const Real* shear, Real* torque) {
  if constexpr (Dim == 2) {
    torque[0] = shear[0] * normal[1] - shear[1] * normal[0];
  } else {
    torque[0] = normal[2] * shear[1] - normal[1] * shear[2];
    torque[1] = normal[0] * shear[2] - normal[2] * shear[0];
    torque[2] = normal[1] * shear[0] - normal[0] * shear[1];
  }
}

/// From the second to the nearest image of the first.
template <int Dim, class Real>
AEOLIAN_INLINE void apart_within_period(const Real* first, const Real* second, const double* period,
                                        Real* apart) {
  for (int d = 0; d < Dim; ++d) {
    const Real direct = first[GrainRecord<Dim>::place + d] - second[GrainRecord<Dim>::place + d];
    const double half = period[d] / 2;
    const Real once = direct > half ? direct - period[d] : direct;
    apart[d] = once < -half ? once + period[d] : once;
  }
}

/// Two grains, given by the numbers of their records. Velocities in the records are those half a step ago;
/// those of now are predicted with the last acceleration. The lever arms end at the middle of the overlap, so
/// that angular momentum is conserved.
template <int Dim, class Real>
struct PairMeeting {
  using Record = GrainRecord<Dim>;

  Meeting<Dim, Real> meeting;
  Real distance, arm_first, arm_second, smaller_radius;

  /// Where the two are; `touching()` and the rest follow.
  AEOLIAN_INLINE void place(const Real* first, const Real* second, const double* period) {
    apart_within_period<Dim>(first, second, period, meeting.normal);
    distance = square_root(dot<Dim>(meeting.normal, meeting.normal));
    meeting.overlap = first[Record::radius] + second[Record::radius] - distance;
    smaller_radius = smaller(first[Record::radius], second[Record::radius]);
  }

  /// The rest, where the overlap is positive.
  AEOLIAN_INLINE void move(const Real* first, const Real* second, double half_step) {
    const Real inverse = 1 / distance;
    for (int d = 0; d < Dim; ++d) meeting.normal[d] = meeting.normal[d] * inverse;
    meeting.mass = 1 / (first[Record::inverse_mass] + second[Record::inverse_mass]);
    const Real radii = first[Record::radius] + second[Record::radius];
    meeting.radius = first[Record::radius] * second[Record::radius] / radii;
    arm_first = first[Record::radius] - 0.5 * meeting.overlap;
    arm_second = second[Record::radius] - 0.5 * meeting.overlap;
    Real arms_midway[Record::turns], arms[Record::turns];
    for (int d = 0; d < Record::turns; ++d) {
      arms_midway[d] = arm_first * first[Record::spin + d] + arm_second * second[Record::spin + d];
      arms[d] = arms_midway[d] + half_step * (arm_first * first[Record::turning + d] +
                                              arm_second * second[Record::turning + d]);
    }
    for (int d = 0; d < Dim; ++d) {
      meeting.midway[d] = first[Record::velocity + d] - second[Record::velocity + d];
      meeting.velocity[d] = meeting.midway[d] +
                            half_step * (first[Record::acceleration + d] - second[Record::acceleration + d]);
    }
    add_turning<Dim>(meeting.normal, arms_midway, meeting.midway);
    add_turning<Dim>(meeting.normal, arms, meeting.velocity);
  }
};

}  // namespace aeolian
