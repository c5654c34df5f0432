#pragma once

#include <complex>

namespace aeolian {

/// Modified Bessel functions of the second kind, of order 0 and 1.
struct BesselK {
  std::complex<double> k0;
  std::complex<double> k1;
};

/// K0 and K1 of an argument with a positive real part, to about 1e-13: the power series near zero, Steed's
/// continued fraction elsewhere (Temme 1975). Far out both underflow to zero.
BesselK bessel_k(std::complex<double> z);

}  // namespace aeolian
