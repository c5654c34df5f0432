#pragma once

#include <cmath>

namespace aeolian::sph {

/// Wendland's C2 kernel in three dimensions, W = 21/(2 pi h^3) (1 - q)^4 (1 + 4 q), q = r/h, zero beyond its
/// support h. Lengths in particle spacings.
struct Wendland {
  explicit Wendland(float reach)
      : support(reach), scale(static_cast<float>(21 / (2 * M_PI)) / (reach * reach * reach)) {}

  float value(float r) const {
    const float t = r < support ? 1 - r / support : 0;
    return scale * (t * t) * (t * t) * (5 - 4 * t);
  }
  /// -W'/r, so that the gradient of W at a particle is this times the way to its neighbour.
  float pull(float r) const {
    const float t = r < support ? 1 - r / support : 0;
    return 20 * scale / (support * support) * t * t * t;
  }

  float support;
  float scale;
};

/// The volume of a particle of a cubic lattice of unit spacing, of which the kernel's sum is one: the mass is
/// calibrated on the lattice, not taken from a sphere.
inline float lattice_volume(const Wendland& kernel) {
  const int n = static_cast<int>(std::ceil(kernel.support));
  double sum = 0;
  for (int z = -n; z <= n; ++z)
    for (int y = -n; y <= n; ++y)
      for (int x = -n; x <= n; ++x)
        sum += static_cast<double>(kernel.value(std::sqrt(static_cast<float>(x * x + y * y + z * z))));
  return static_cast<float>(1 / sum);
}

}  // namespace aeolian::sph
