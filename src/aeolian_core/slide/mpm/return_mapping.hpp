#pragma once

#include "aeolian_core/slide/mpm/snow_law.hpp"
#include "aeolian_core/slide/mpm/symmetric.hpp"

namespace aeolian {

/// A SnowLaw in the numbers that the return mapping takes.
struct YieldConstants {
  static constexpr double weakest = 1e-5;  ///< p0 over K that no snow falls below

  SnowLaw::Yield yield = SnowLaw::Yield::cam_clay;
  int dimensions = 3;
  double shear = 0;              ///< mu [Pa]
  double bulk = 0;               ///< K_d [Pa]
  double hardening_modulus = 0;  ///< K [Pa]
  double hardening = 0;          ///< xi
  double slope = 0;              ///< M
  double slope_squared = 0;
  double cohesion = 0;  ///< beta
};
YieldConstants yield_constants(const SnowLaw& law, int dimensions);

/// p0 after a compaction alpha [Pa].
template <class Real>
AEOLIAN_INLINE Real consolidation_pressure(const YieldConstants& k, Real alpha) {
  const Real e = exponential(k.hardening * not_negative(alpha));
  const Real p0 = 0.5 * k.hardening_modulus * (e - 1.0 / e);
  return larger(p0, constant<Real>(YieldConstants::weakest * k.hardening_modulus));
}

/// Invariants of a stress [Pa].
template <class Real>
struct Invariants {
  Real p, q;
};

/// Brings a trial stress back to the Cam-Clay ellipse (1 + 2 beta) q^2 + M^2 (p + beta p0)(p - p0) = 0 by
/// associated flow; p0 is that at the beginning of the step. A stress within the ellipse stays.
///
/// About the ellipse's centre the condition reads S(g) = A / (1 + a g)^2 + B / (1 + k g)^2 = D, the nearest
/// point on an ellipse. 1 / sqrt(S) is increasing and concave, so Newton's method on it comes from below
/// without a step too far (Moré & Sorensen 1983) and needs no bracket.
template <class Real>
AEOLIAN_INLINE Invariants<Real> returned_to_ellipse(const YieldConstants& y, Invariants<Real> trial,
                                                    Real p0) {
  const Real centre = (0.5 * (1 - y.cohesion)) * p0;
  const Real off = trial.p - centre;
  const Real half_axis = (0.5 * (1 + y.cohesion)) * p0;
  const double widening = 1 + 2 * y.cohesion;
  const double a = 6 * y.shear * widening;  // 4 mu c2 (1 + 2 beta) with c2 = 3/2
  const double k = 2 * y.bulk * y.slope_squared;
  const Real q_part = widening * trial.q * trial.q;
  const Real p_part = y.slope_squared * off * off;
  const Real limit = y.slope_squared * half_axis * half_axis;
  const auto outside = q_part + p_part > limit;
  if (!any(outside)) return trial;
  // Scaled by 1 / a, so that the unknown has no unit.
  const double ratio = k / a;
  Real g = constant<Real>(0);
  constexpr int steps_most = 60;
  for (int step = 0; step < steps_most; ++step) {
    const Real u = 1.0 / (1.0 + g);
    const Real w = 1.0 / (1.0 + ratio * g);
    const Real qs = q_part * u * u;
    const Real ps = p_part * w * w;
    const Real sum = qs + ps;
    const Real slope = qs * u + ratio * (ps * w);  // of -sum / 2
    const Real change = sum * (square_root(sum / limit) - 1.0) / slope;
    const auto going_on = outside && change > 1e-14 * (1.0 + g);
    if (!any(going_on)) break;
    g = going_on ? g + change : g;
  }
  Invariants<Real> result;
  result.p = outside ? centre + off / (1.0 + ratio * g) : trial.p;
  result.q = outside ? trial.q / (1.0 + g) : trial.q;
  return result;
}

/// Stress of an elastic state that a step has strained, after the plastic flow that it asks for.
///
/// `b` is the left Cauchy-Green tensor F F^T of the elastic part, the trial state on entry and the returned
/// one on exit. The law is isotropic, so the rotation of F never enters: no singular value decomposition is
/// needed, and an element turned inside out has the stress of its mirror image. `alpha` is the plastic
/// compaction of snow, the volume to be lost again of a granular medium. `tau` is the Kirchhoff stress [Pa].
template <int Dim, class Real>
AEOLIAN_INLINE void flow_and_stress(const YieldConstants& y, Real b[symmetric_size<Dim>], Real& alpha,
                                    Real tau[symmetric_size<Dim>]) {
  const Spectrum<Dim, Real> spectrum(b);
  // No stretch beyond 1e6 or below 1e-6, nor 1e-6 of the largest: what numbers can tell apart.
  Real largest = spectrum.values[0];
  Real least = spectrum.values[0];
  for (int k = 1; k < Dim; ++k) {
    largest = larger(largest, spectrum.values[k]);
    least = smaller(least, spectrum.values[k]);
  }
  const Real floor = larger(constant<Real>(1e-12), 1e-12 * smaller(largest, constant<Real>(1e12)));
  Real strain[Dim];
  Real trace = constant<Real>(0);
  for (int k = 0; k < Dim; ++k) {
    strain[k] = 0.5 * natural_log(larger(smaller(spectrum.values[k], constant<Real>(1e12)), floor));
    trace += strain[k];
  }
  Real deviator[Dim];
  Real squares = constant<Real>(0);
  for (int k = 0; k < Dim; ++k) {
    deviator[k] = strain[k] - trace / static_cast<double>(Dim);
    squares += deviator[k] * deviator[k];
  }
  const double root_of_3_2 = 1.2247448713915890;
  Real kept = constant<Real>(1);  // share of the deviator that stays
  Real new_trace = trace;
  if (y.yield == SnowLaw::Yield::cam_clay) {
    const Invariants<Real> trial{-y.bulk * trace, 2 * root_of_3_2 * y.shear * square_root(squares)};
    const Real p0 = consolidation_pressure(y, alpha);
    const Invariants<Real> stress = returned_to_ellipse(y, trial, p0);
    const auto sheared = trial.q > 0.0;
    kept = sheared ? stress.q / (sheared ? trial.q : constant<Real>(1)) : constant<Real>(1);
    new_trace = -stress.p / y.bulk;
    alpha += new_trace - trace;  // the flow expands by p - p_trial over K_d; compaction counts positive
  } else if (y.yield == SnowLaw::Yield::drucker_prager) {
    const Real owed = trace + alpha;
    const auto loose = owed >= 0.0;
    new_trace = loose ? constant<Real>(0) : owed;
    alpha = loose ? owed : constant<Real>(0);
    const Real allowed = -y.slope * y.bulk * new_trace;
    const Real q = 2 * root_of_3_2 * y.shear * square_root(squares);
    const auto yields = q > allowed;
    kept = yields ? allowed / (yields ? q : constant<Real>(1)) : constant<Real>(1);
  }
  const auto flowed = kept < 1.0 || new_trace < trace || new_trace > trace;
  Real principal[Dim], stretch[Dim];
  for (int k = 0; k < Dim; ++k) {
    const Real returned = kept * deviator[k] + new_trace / static_cast<double>(Dim);
    principal[k] = 2 * y.shear * kept * deviator[k] + y.bulk * new_trace;
    stretch[k] = returned;
  }
  spectrum.compose(principal, tau);
  const auto torn = least < floor || largest > 1e12;  // the trial state was held in bounds
  if (!any(flowed) && !any(torn)) return;
  for (int k = 0; k < Dim; ++k) stretch[k] = exponential(2.0 * stretch[k]);
  Real returned[symmetric_size<Dim>];
  spectrum.compose(stretch, returned);
  for (int k = 0; k < symmetric_size<Dim>; ++k) b[k] = (flowed || torn) ? returned[k] : b[k];
}

}  // namespace aeolian
