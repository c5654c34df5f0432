#pragma once

namespace aeolian {

/// Third-order value within a step of length `h` from values and derivatives at its ends; `part` from 0 to 1.
inline double hermite(double part, double h, double p0, double d0, double p1, double d1) {
  const double q = 1 - part;
  return q * q * ((1 + 2 * part) * p0 + part * h * d0) + part * part * ((1 + 2 * q) * p1 - q * h * d1);
}

}  // namespace aeolian
