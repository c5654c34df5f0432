#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {

/// Which of the 2^Bits pieces in each factor of two a number of one or more lies in, counted from one.
template <int Bits>
AEOLIAN_INLINE std::size_t octave_piece(double x) {
  std::int64_t bits = 0;
  std::memcpy(&bits, &x, sizeof bits);
  return static_cast<std::size_t>((bits >> (52 - Bits)) - (std::int64_t{1023} << Bits));
}

/// A function of a positive number as straight pieces, 2^Bits of equal width in every factor of two: the
/// piece is read off the number's bits, without a logarithm.
template <int Bits>
class OctaveTable {
 public:
  static constexpr int per_octave = 1 << Bits;

  /// From 2^first to 2^(first + octaves).
  OctaveTable(int first, int octaves)
      : base_((static_cast<std::int64_t>(first) + 1023) << Bits),
        offset_(static_cast<std::size_t>(octaves) * per_octave),
        slope_(offset_.size()),
        first_(first) {}

  std::size_t pieces() const { return offset_.size(); }
  /// Where piece `i` begins; i = pieces(): where the last ends.
  double knot(std::size_t i) const {
    const auto octave = static_cast<int>(i / per_octave);
    const double within = static_cast<double>(i % per_octave) / per_octave;
    return __builtin_ldexp(1 + within, first_ + octave);
  }
  /// Sets a piece to the line through its ends.
  void set(std::size_t i, double at_begin, double at_end) {
    const double begin = knot(i);
    slope_[i] = (at_end - at_begin) / (knot(i + 1) - begin);
    offset_[i] = at_begin - slope_[i] * begin;
  }

  /// What a loop over plain arrays needs. `x` must lie within the table.
  struct View {
    const double* offset;
    const double* slope;
    std::int64_t base;

    AEOLIAN_INLINE double operator()(double x) const {
      std::int64_t bits = 0;
      std::memcpy(&bits, &x, sizeof bits);
      const std::int64_t i = (bits >> (52 - Bits)) - base;
      return offset[i] + slope[i] * x;
    }
  };
  View view() const { return {offset_.data(), slope_.data(), base_}; }
  double operator()(double x) const { return view()(x); }

 private:
  std::int64_t base_;
  std::vector<double> offset_;
  std::vector<double> slope_;
  int first_;
};

}  // namespace aeolian
