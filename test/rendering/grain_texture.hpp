#pragma once

#include <cstdint>

namespace aeolian {

/// Grains lying side by side on a bed: cells of one grain each around jittered points of a staggered lattice,
/// the same wherever and however often they are looked at.
class GrainTexture {
 public:
  struct Grain {
    double albedo = 0;  ///< standard normal
    double height = 0;  ///< standard normal, within +-3.46
    double x = 0;       ///< from its middle to the point asked for, in diameters
    double y = 0;
  };

  GrainTexture(double diameter, std::uint64_t seed) : per_diameter_(1 / diameter), seed_(mix(seed + 1)) {}

  Grain at(double x, double y) const {
    const double row = y * per_diameter_;
    const std::int64_t j0 = floor(row - 0.5);
    Grain grain;
    double nearest = 1e9;
    std::uint64_t bits = 0;
    for (std::int64_t j = j0; j <= j0 + 1; ++j) {
      const double column = x * per_diameter_ - ((j & 1) != 0 ? 0.5 : 0.0);
      const std::int64_t i0 = floor(column - 0.5);
      for (std::int64_t i = i0; i <= i0 + 1; ++i) {
        const std::uint64_t cell = bits_of(i, j);
        const double dx = column - (static_cast<double>(i) + 0.3 + fraction(cell, 0));
        const double dy = row - (static_cast<double>(j) + 0.3 + fraction(cell, 16));
        const double distance = dx * dx + dy * dy;
        if (distance < nearest) {
          nearest = distance;
          bits = cell;
          grain.x = dx;
          grain.y = dy;
        }
      }
    }
    grain.albedo = normal(mix(bits + 1));
    grain.height = normal(mix(bits + 2));
    return grain;
  }

  /// The same bed where grains are about a pixel or less and their outlines do not count.
  Grain shapeless_at(double x, double y) const {
    const std::int64_t j = floor(y * per_diameter_);
    const std::int64_t i = floor(x * per_diameter_ - ((j & 1) != 0 ? 0.5 : 0.0));
    const std::uint64_t bits = bits_of(i, j);
    return {normal(mix(bits + 1)), normal(mix(bits + 2)), 0, 0};
  }

  /// The finaliser of MurmurHash3 (Appleby 2011).
  static std::uint64_t mix(std::uint64_t k) {
    k ^= k >> 33U;
    k *= 0xff51afd7ed558ccdULL;
    k ^= k >> 33U;
    k *= 0xc4ceb9fe1a85ec53ULL;
    return k ^ (k >> 33U);
  }
  /// Nearly standard normal: the sum of four uniform numbers.
  static double normal(std::uint64_t bits) {
    const std::uint64_t sum =
        (bits & 0xFFFFU) + ((bits >> 16U) & 0xFFFFU) + ((bits >> 32U) & 0xFFFFU) + (bits >> 48U);
    return (static_cast<double>(sum) - 131070) * (1.7320508 / 65536);
  }

 private:
  std::uint64_t bits_of(std::int64_t i, std::int64_t j) const {
    return mix((static_cast<std::uint64_t>(i) << 32U) ^ (static_cast<std::uint64_t>(j) & 0xFFFFFFFFU) ^
               seed_);
  }
  static std::int64_t floor(double v) {  // std::floor is a call on the baseline processor
    const auto towards_zero = static_cast<std::int64_t>(v);
    return towards_zero - (v < static_cast<double>(towards_zero) ? 1 : 0);
  }
  static double fraction(std::uint64_t bits, unsigned shift) {
    return static_cast<double>((bits >> shift) & 0xFFFFU) * (0.4 / 65536);
  }

  double per_diameter_;
  std::uint64_t seed_;
};

}  // namespace aeolian
