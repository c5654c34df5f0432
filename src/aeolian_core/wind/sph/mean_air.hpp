#pragma once

#include "aeolian_core/wind/sph/sph_air.hpp"

namespace aeolian::sph {

/// The wind at a point of a box: of the linear field that fits the particles around it best, weighted by the
/// kernel, so that it is right at a wall too, which has air on one side only.
struct AirProbe {
  Four velocity{};
  float air = 0;       ///< the sum of the kernel: one within the air, half at a wall
  bool valid = false;  ///< enough air to tell
};
/// `at` in spacings.
AirProbe probe(const SphAir& air, const Four& at);

/// The mean over time of the wind in a box, at sites a spacing apart, in columns that stand on the ground.
class MeanAir {
 public:
  explicit MeanAir(const SphAir& air);
  /// Adds the wind as it is.
  void add(const SphAir& air);

  /// In U, between the sites of the columns around (x, y) at the same height over their ground; in spacings
  /// of the box. Not a number where no probe was valid.
  Four at(float x, float y, float height) const;

 private:
  std::size_t index(int x, int y, int z) const;

  int nx_, ny_, nz_;
  std::vector<Four> sum_;
  std::vector<float> count_;
};

}  // namespace aeolian::sph
