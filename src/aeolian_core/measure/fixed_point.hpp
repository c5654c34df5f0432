#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace aeolian {

/// Whole numbers for the sums of the fusion, so that they do not depend on order, chunks or threads.
///
/// Heights count steps of 2^-17 m = 7.6 um in 32 bits: +-16 384 m, rounded to the nearest; the rounding adds
/// (2.2 um)^2 to a variance. Weights (inverse variances) count 1/65536 of the weight of a reference variance
/// in 22 bits: a point may be 8 times as sharp or, to some percent, 50 times as blunt as the reference;
/// beyond 1/256 and 8 times it is taken to be at that bound. Sums are doubles that hold whole numbers: exact,
/// and so the same in any order, while the sum of weight x |deviation| stays below 2^53 (30 million points of
/// the reference weight 3 cm off their prediction).
namespace fixed {
constexpr double steps_per_metre = 131072;
constexpr double step = 1 / steps_per_metre;
/// Heights farther from zero [m] are nonsense.
constexpr double greatest_height = 16383;

constexpr double reference_weight = 65536;
constexpr double greatest_weight = (1 << 22) - 1;

inline double metres(std::int64_t steps) { return static_cast<double>(steps) * step; }
/// To the nearest whole number, halves up.
inline std::int32_t nearest(double value) { return static_cast<std::int32_t>(std::floor(value + 0.5)); }
inline std::int32_t steps(double metres) {
  return nearest(std::clamp(metres, -greatest_height, greatest_height) * steps_per_metre);
}
}  // namespace fixed

/// One point on its way into a tile: its cell within the tile, height and weight in 64 bits. The order of the
/// bits is cell, height, weight: sorted samples lie cell by cell, the lowest first.
class Sample {
 public:
  Sample() = default;
  explicit Sample(std::uint64_t bits) : bits_(bits) {}
  Sample(std::uint32_t cell, std::int32_t height, std::uint32_t weight)
      : bits_(std::uint64_t{cell} << 54 | std::uint64_t{static_cast<std::uint32_t>(height) ^ flip} << 22 |
              weight) {}

  std::uint32_t cell() const { return static_cast<std::uint32_t>(bits_ >> 54); }
  std::int32_t height() const {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(bits_ >> 22) ^ flip);
  }
  std::uint32_t weight() const { return static_cast<std::uint32_t>(bits_) & ((1U << 22) - 1); }
  std::uint64_t bits() const { return bits_; }
  friend bool operator<(Sample a, Sample b) { return a.bits_ < b.bits_; }

 private:
  static constexpr std::uint32_t flip = 0x80000000U;  // signed order as unsigned order
  std::uint64_t bits_;
};

}  // namespace aeolian
