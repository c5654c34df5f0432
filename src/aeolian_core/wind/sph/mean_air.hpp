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

/// The mean over time of the wind over the ground of a box, at sites a spacing apart along x and y and at
/// heights over the ground of 0, 1, 2, ... spacings.
class MeanAir {
 public:
  /// Up to `levels` spacings.
  MeanAir(const SphAir& air, int levels);
  /// Adds the wind as it is.
  void add(const SphAir& air);

  int levels() const { return levels_; }
  /// Trilinear, in U; in spacings of the box and over the ground. Where no probe was valid: not a number.
  Four at(float x, float y, float height) const;
  /// Probes that found too little air, over all.
  double invalid_share() const;

 private:
  std::size_t index(int x, int y, int level) const;

  int nx_, ny_, levels_;
  std::vector<Four> sum_;
  std::vector<float> count_;
  std::size_t asked_ = 0;
};

}  // namespace aeolian::sph
