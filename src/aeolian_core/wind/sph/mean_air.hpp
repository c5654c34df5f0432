#pragma once

#include "aeolian_core/wind/sph/sph_air.hpp"

namespace aeolian::sph {

/// The wind at a point of a box: Shepard's mean of the particles around it, each with what its velocity's
/// derivatives tell (so that a linear field comes out as it is).
struct AirProbe {
  Four velocity{};
  float air = 0;       ///< the sum of the kernel: one within the air, half at a wall
  bool valid = false;  ///< enough air to tell
};
/// `at` in spacings.
AirProbe probe(const SphAir& air, const Four& at);

/// The mean over time of the wind in a box, at sites a spacing apart from its floor to its lid; those in the
/// ground are told from the air beside them.
class MeanAir {
 public:
  explicit MeanAir(const SphAir& air);
  /// Adds the wind as it is.
  void add(const SphAir& air);

  /// Trilinear, in U; at a place in spacings of the box. Where no probe was valid: not a number.
  Four at(float x, float y, float z) const;

 private:
  std::size_t index(int x, int y, int z) const;

  int nx_, ny_, nz_;
  std::vector<Four> sum_;
  std::vector<float> count_;
};

}  // namespace aeolian::sph
