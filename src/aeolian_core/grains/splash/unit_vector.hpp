#pragma once

#include <cmath>

#include <Eigen/Core>

namespace aeolian {

/// (cos, sin) of an angle from 0 to pi [rad], to 1e-11: Taylor's series about pi / 2, several times as fast
/// as the library's, which is right for all angles.
inline Eigen::Vector2d unit_vector(double angle) {
  const double x = M_PI / 2 - angle;
  const double s = x * x;
  const double sine =
      x * (1 + s * (-1.0 / 6 + s * (1.0 / 120 +
                                    s * (-1.0 / 5040 + s * (1.0 / 362880 + s * (-1.0 / 39916800 +
                                                                                s * (1.0 / 6227020800 -
                                                                                     s / 1307674368000)))))));
  const double cosine =
      1 + s * (-0.5 + s * (1.0 / 24 +
                           s * (-1.0 / 720 +
                                s * (1.0 / 40320 + s * (-1.0 / 3628800 +
                                                        s * (1.0 / 479001600 + s * (-1.0 / 87178291200 +
                                                                                    s / 20922789888000)))))));
  return {sine, cosine};
}

}  // namespace aeolian
