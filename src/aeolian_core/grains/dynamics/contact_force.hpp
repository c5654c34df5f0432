#pragma once

#include "aeolian_core/grains/dynamics/contact_law.hpp"
#include "aeolian_core/surface/lanes.hpp"

namespace aeolian {

/// The law's constants as the formulae want them.
struct LawConstants {
  explicit LawConstants(const ContactLaw& law);

  bool hertz;
  double stiffness, damping, shear_stiffness, shear_compliance, shear_damping;  ///< of a spring
  double modulus;        ///< of Hertz: force = modulus sqrt(radius) overlap^1.5
  double shear_modulus;  ///< of Mindlin: shear stiffness = modulus sqrt(radius overlap)
  double loss;           ///< of Tsuji: damping = loss sqrt(mass stiffness)
  double friction;
};

/// Two bodies that touch, in whatever way the overlap came about.
template <int Dim, class Real>
struct Meeting {
  Real normal[Dim];    ///< from the second to the first
  Real overlap;        ///< positive
  Real mass, radius;   ///< effective ones
  Real velocity[Dim];  ///< of the first's surface relative to the second's
  Real midway[Dim];    ///< the same half a step ago
};

template <int Dim, class Real>
struct Answer {
  Real normal;      ///< pushes [N]
  Real shear[Dim];  ///< on the first [N]
};

template <int Dim, class Real>
AEOLIAN_INLINE Real dot(const Real* a, const Real* b) {
  Real sum = a[0] * b[0] + a[1] * b[1];
  if constexpr (Dim == 3) sum = sum + a[2] * b[2];
  return sum;
}

/// Werner (1987), eq. 2.3, and its sibling after Hertz, Mindlin and Tsuji et al. (1992). `slip` is the shear
/// spring's displacement, kept from step to step.
///
/// A contact begins and ends between steps. The damping forces jump there, so they count for the share of the
/// step during which the grains touch, up to half a step to the other side of now, and a linear spring gives
/// the impulse of that time: since when is known from the speed half a step ago, until when is foreseen. A
/// new contact's shear spring is stretched only since its beginning. Without this the scheme would be of
/// first order with damping, and lose its hold on the energy without.
template <bool hertz, int Dim, class Real>
AEOLIAN_INLINE void answer(const LawConstants& law, double dt, const Meeting<Dim, Real>& m, Real* slip,
                           Answer<Dim, Real>& out) {
  const Real parting = dot<Dim>(m.velocity, m.normal);
  const Real parting_midway = dot<Dim>(m.midway, m.normal);
  constexpr double tiny = 1e-300;  // keeps the quotient positive at rest
  const Real speed = parting_midway < 0 ? -parting_midway : not_negative(2 * parting - parting_midway);
  const Real way = speed * dt + tiny;
  const Real passage = m.overlap / way;
  const Real share = 0.5 + (passage < 1 ? passage : 0.5);

  Real elastic, damping, shear_stiffness, shear_compliance, shear_damping, kept;
  if constexpr (hertz) {
    const Real contact = square_root(m.radius * m.overlap);
    const Real stiffness = law.modulus * contact;
    elastic = stiffness * m.overlap;
    damping = law.loss * square_root(m.mass * stiffness);
    shear_stiffness = law.shear_modulus * contact;
    shear_compliance = 1 / shear_stiffness;
    shear_damping = damping;
    // An unloading contact narrows and takes its share of the shear spring with it; a growing one adds
    // nothing to the force, else a cycle of loading would yield energy.
    const Real before = not_negative(m.overlap + parting_midway * dt);
    kept = before < m.overlap ? square_root(before / m.overlap) : 1.0;
  } else {
    elastic = law.stiffness * (passage < 1 ? 0.5 * share * share * way : m.overlap);
    damping = law.damping * m.mass;
    shear_stiffness = constant<Real>(law.shear_stiffness);
    shear_compliance = constant<Real>(law.shear_compliance);
    shear_damping = law.shear_damping * m.mass;
    kept = constant<Real>(1);
  }
  out.normal = elastic - share * damping * parting;

  const Real lasted = (passage < 1) & (parting_midway < 0) ? passage * dt : dt;
  const Real limit = law.friction * not_negative(out.normal);
  const Real bound = limit * shear_compliance;
  shear_damping = share * shear_damping;
  if constexpr (Dim == 2) {
    const Real along[2] = {m.normal[1], -m.normal[0]};
    const Real spring = slip[0] * kept - lasted * dot<2>(m.midway, along);
    const Real shear = within(shear_stiffness * spring - shear_damping * dot<2>(m.velocity, along), limit);
    slip[0] = within(spring, bound);
    out.shear[0] = shear * along[0];
    out.shear[1] = shear * along[1];
  } else {
    // The spring turns with the tangent plane and keeps its length.
    const Real out_of_plane = dot<3>(slip, m.normal);
    Real turned[3];
    for (int d = 0; d < 3; ++d) turned[d] = slip[d] - out_of_plane * m.normal[d];
    const Real in_plane = dot<3>(turned, turned);
    const Real longer = in_plane > 0 ? square_root(dot<3>(slip, slip) / in_plane) : 1.0;
    Real shear[3];
    for (int d = 0; d < 3; ++d) {
      turned[d] = turned[d] * longer * kept - lasted * (m.midway[d] - parting_midway * m.normal[d]);
      shear[d] = shear_stiffness * turned[d] - shear_damping * (m.velocity[d] - parting * m.normal[d]);
    }
    const Real length = square_root(dot<3>(turned, turned));
    const Real size = square_root(dot<3>(shear, shear));
    const Real spring_share = length > bound ? bound / length : 1.0;
    const Real shear_share = size > limit ? limit / size : 1.0;
    for (int d = 0; d < 3; ++d) {
      slip[d] = turned[d] * spring_share;
      out.shear[d] = shear[d] * shear_share;
    }
  }
}

}  // namespace aeolian
