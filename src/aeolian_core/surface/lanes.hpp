#pragma once

#include <cmath>

#include "aeolian_core/surface/kernel.hpp"

/// Four numbers that a processor treats at once; everything here is written for one number, too, so that a
/// formula over `Real` is its own scalar twin.

#pragma GCC diagnostic ignored "-Wpsabi"  // all of it is inlined: no vector crosses a call

namespace aeolian {

using Lanes = double __attribute__((vector_size(32)));
constexpr int lane_count = 4;

AEOLIAN_INLINE double square_root(double a) { return std::sqrt(a); }
AEOLIAN_INLINE Lanes square_root(const Lanes& a) {
  return Lanes{std::sqrt(a[0]), std::sqrt(a[1]), std::sqrt(a[2]), std::sqrt(a[3])};
}

template <class Real>
AEOLIAN_INLINE Real constant(double value) {
  return Real{} + value;
}
template <class Real>
AEOLIAN_INLINE Real not_negative(Real a) {
  return a > 0 ? a : 0.0;
}
template <class Real>
AEOLIAN_INLINE Real larger(Real a, Real b) {
  return a > b ? a : b;
}
template <class Real>
AEOLIAN_INLINE Real smaller(Real a, Real b) {
  return a < b ? a : b;
}
template <class Real>
AEOLIAN_INLINE Real size_of(Real a) {
  return a < 0 ? -a : a;
}
/// Between -bound and bound.
template <class Real>
AEOLIAN_INLINE Real within(Real a, Real bound) {
  return larger(smaller(a, bound), -bound);
}

AEOLIAN_INLINE Lanes load_lanes(const double* from) {
  Lanes lanes;
  __builtin_memcpy(&lanes, from, sizeof lanes);
  return lanes;
}
AEOLIAN_INLINE void store_lanes(double* to, const Lanes& lanes) {
  __builtin_memcpy(to, &lanes, sizeof lanes);
}

/// Rows to columns, in place.
AEOLIAN_INLINE void transpose(Lanes& a, Lanes& b, Lanes& c, Lanes& d) {
  const Lanes ab_even = __builtin_shufflevector(a, b, 0, 4, 2, 6);
  const Lanes ab_odd = __builtin_shufflevector(a, b, 1, 5, 3, 7);
  const Lanes cd_even = __builtin_shufflevector(c, d, 0, 4, 2, 6);
  const Lanes cd_odd = __builtin_shufflevector(c, d, 1, 5, 3, 7);
  a = __builtin_shufflevector(ab_even, cd_even, 0, 1, 4, 5);
  b = __builtin_shufflevector(ab_odd, cd_odd, 0, 1, 4, 5);
  c = __builtin_shufflevector(ab_even, cd_even, 2, 3, 6, 7);
  d = __builtin_shufflevector(ab_odd, cd_odd, 2, 3, 6, 7);
}

}  // namespace aeolian
