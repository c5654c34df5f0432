#include "aeolian_core/wind/bessel_k.hpp"

#include <cmath>

namespace aeolian {
namespace {

using Complex = std::complex<double>;
constexpr double euler_gamma = 0.57721566490153286;
constexpr double series_reach = 2;  ///< of |z|
constexpr double precision = 1e-15;

/// Abramowitz & Stegun 9.6.10 to 9.6.13.
BesselK by_series(Complex z) {
  const Complex t = 0.25 * z * z;
  const Complex log_half = std::log(0.5 * z);
  Complex term = 1;  // t^m / (m!)^2
  double harmonic = 0;
  Complex i0 = 1;
  Complex i1 = 1;
  Complex sum0 = 0;
  Complex sum1 = 1 - 2 * euler_gamma;  // psi(1) + psi(2)
  for (int m = 1; m < 40; ++m) {
    term *= t / static_cast<double>(m * m);
    harmonic += 1.0 / m;
    const Complex next = term / static_cast<double>(m + 1);
    i0 += term;
    i1 += next;
    sum0 += harmonic * term;
    sum1 += (2 * harmonic + 1.0 / (m + 1) - 2 * euler_gamma) * next;
    if (std::abs(term) < precision) break;
  }
  return {-(log_half + euler_gamma) * i0 + sum0, 1.0 / z + 0.5 * z * (log_half * i1 - 0.5 * sum1)};
}

BesselK by_continued_fraction(Complex z) {
  Complex b = 2.0 * (1.0 + z);
  Complex d = 1.0 / b;
  Complex step = d;
  Complex h = d;
  Complex q1 = 0;
  Complex q2 = 1;
  constexpr double a1 = 0.25;
  Complex q = a1;
  double c = a1;
  double a = -a1;
  Complex s = 1.0 + q * step;
  for (int i = 2; i < 10000; ++i) {
    a -= 2 * (i - 1);
    c = -a * c / i;
    const Complex next = (q1 - b * q2) / a;
    q1 = q2;
    q2 = next;
    q += c * next;
    b += 2.0;
    d = 1.0 / (b + a * d);
    step *= b * d - 1.0;
    h += step;
    const Complex part = q * step;
    s += part;
    if (std::abs(part) < precision * std::abs(s)) break;
  }
  const Complex k0 = std::sqrt(M_PI / (2.0 * z)) * std::exp(-z) / s;
  return {k0, k0 * (z + 0.5 - a1 * h) / z};
}

}  // namespace

BesselK bessel_k(Complex z) { return std::abs(z) <= series_reach ? by_series(z) : by_continued_fraction(z); }

}  // namespace aeolian
