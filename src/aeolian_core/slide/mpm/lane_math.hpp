#pragma once

#include <cmath>

#include "aeolian_core/surface/lanes.hpp"

/// Functions of one number and of four at once, for laws that are written over `Real`.

namespace aeolian {

/// What a comparison of lanes gives: all bits of a lane set or none.
using LaneBits = decltype(Lanes{} < Lanes{});

AEOLIAN_INLINE LaneBits bits_of(const Lanes& a) { return reinterpret_cast<LaneBits>(a); }
AEOLIAN_INLINE Lanes from_bits(const LaneBits& a) { return reinterpret_cast<Lanes>(a); }

AEOLIAN_INLINE bool any(bool a) { return a; }
AEOLIAN_INLINE bool any(const LaneBits& a) { return (a[0] | a[1] | a[2] | a[3]) != 0; }

AEOLIAN_INLINE double natural_log(double a) { return std::log(a); }
/// Of positive normal numbers, to a unit in the last place: a = 2^e (1 + f), the series of
/// log((1 + s) / (1 - s)) with s = f / (2 + f), and its minimax remainder (fdlibm, e_log.c).
AEOLIAN_INLINE Lanes natural_log(const Lanes& a) {
  constexpr double ln2_high = 6.93147180369123816490e-01;
  constexpr double ln2_low = 1.90821492927058770002e-10;
  constexpr long root_half = 0x3fe6a09e667f3bcd;  // bits of sqrt(1/2): the mantissa begins there
  const LaneBits shifted = bits_of(a) - root_half;
  const LaneBits exponent = shifted >> 52;
  const Lanes f = from_bits((shifted & 0x000fffffffffffffL) + root_half) - 1.0;
  // A whole number in the low bits of 1.5 * 2^52 is that number after subtraction.
  const Lanes e = from_bits(exponent + 0x4338000000000000L) - 6755399441055744.0;
  const Lanes s = f / (f + 2.0);
  const Lanes z = s * s;
  const Lanes remainder =
      z * (6.666666666666735130e-01 +
           z * (3.999999999940941908e-01 +
                z * (2.857142874366239149e-01 +
                     z * (2.222219843214978396e-01 +
                          z * (1.818357216161805012e-01 +
                               z * (1.531383769920937332e-01 + z * 1.479819860511658591e-01))))));
  const Lanes half_square = 0.5 * f * f;
  return e * ln2_high - ((half_square - (s * (half_square + remainder) + e * ln2_low)) - f);
}

AEOLIAN_INLINE double exponential(double a) { return std::exp(a); }
/// To a few units in the last place; arguments are held within +-700.
AEOLIAN_INLINE Lanes exponential(const Lanes& a) {
  constexpr double magic = 6755399441055744.0;  // 1.5 * 2^52: adding it rounds to a whole number
  const Lanes x = within(a, constant<Lanes>(700.0));
  const Lanes rounded = x * 1.44269504088896340736 + magic;
  const Lanes n = rounded - magic;
  const Lanes r = (x - n * 6.93147180369123816490e-01) - n * 1.90821492927058770002e-10;
  Lanes sum = constant<Lanes>(1.0 / 6227020800.0);
  constexpr double reciprocals[] = {
      1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880, 1.0 / 40320, 1.0 / 5040, 1.0 / 720,
      1.0 / 120,       1.0 / 24,       1.0 / 6,       1.0 / 2,      1.0,         1.0};
  for (const double c : reciprocals) sum = sum * r + c;
  return from_bits(bits_of(sum) + (bits_of(rounded) << 52));
}

}  // namespace aeolian
