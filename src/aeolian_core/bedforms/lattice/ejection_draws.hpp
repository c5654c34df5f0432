#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// What is random about an ejection of the lattice bed, drawn ahead of need, many at once.
class EjectionDraws {
 public:
  struct Draw {
    float gap;           ///< to the next impact; exponential with mean 1
    float length;        ///< of the hop; exponential with mean 1
    float across;        ///< bell-shaped with standard deviation 1
    std::uint32_t ways;  ///< on the way up and down slopes
  };

  explicit EjectionDraws(std::uint64_t seed) : philox_(seed) {}

  Draw next() {
    if (used_ == count) refill();
    const std::size_t i = used_++;
    return {gap_[i], length_[i], across_[i], ways_[i]};
  }

 private:
  static constexpr std::size_t count = 128;

  void refill();

  Philox philox_;
  std::uint64_t drawn_ = 0;
  std::size_t used_ = count;
  std::array<float, count> gap_{}, length_{}, across_{};
  std::array<std::uint32_t, count> ways_{};
};

}  // namespace aeolian
