#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/surface/require.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {

/// The wind before it meets any relief, in units of its own scale: the friction velocity of a log law, or the
/// speed of a wind that is the same at all heights, as in theory without friction.
class UpwindProfile {
 public:
  /// u/u* = ln(z/z0)/kappa over ground of roughness z0 [m], positive; throws Error otherwise.
  static UpwindProfile log_law(double roughness) {
    Require("wind")(roughness > 0 && std::isfinite(roughness), "roughness length", roughness, "positive [m]");
    return UpwindProfile(roughness);
  }
  static UpwindProfile uniform() { return UpwindProfile(0); }

  bool sheared() const { return roughness_ > 0; }
  double roughness() const { return roughness_; }
  /// At a height over the ground [m]; zero at and below the roughness length.
  double speed(double height) const {
    if (!sheared()) return 1;
    return height > roughness_ ? std::log(height / roughness_) / von_karman : 0;
  }
  /// Its mean between two heights [m].
  double mean(double low, double high) const {
    if (!sheared()) return 1;
    const double from = std::max(low, roughness_);
    if (high <= from) return 0;
    const auto integral = [&](double z) { return z * (std::log(z / roughness_) - 1) / von_karman; };
    return (integral(high) - integral(from)) / (high - low);
  }

 private:
  explicit UpwindProfile(double roughness) : roughness_(roughness) {}
  double roughness_;
};

}  // namespace aeolian
