#include "aeolian_core/bedforms/lattice/ejection_draws.hpp"

#include <algorithm>
#include <cstring>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

/// -log(u) of a u uniform in (0, 1), to a millionth: the exponent of its 24 bits and log((1 + s) / (1 - s)) =
/// 2 (s + s^3/3 + ...) of what remains, which is within sqrt(2) of 1.
AEOLIAN_INLINE float exponential(std::uint32_t word) {
  const float bits = static_cast<float>(static_cast<std::int32_t>(word >> 8)) + 0.5F;
  constexpr std::int32_t sqrt_half = 0x3F3504F3;
  std::int32_t pattern = 0;
  std::memcpy(&pattern, &bits, sizeof pattern);
  pattern -= sqrt_half;
  const auto exponent = static_cast<float>(pattern >> 23);
  pattern = (pattern & 0x7FFFFF) + sqrt_half;
  float rest = 0;
  std::memcpy(&rest, &pattern, sizeof rest);
  const float s = (rest - 1) / (rest + 1);
  const float square = s * s;
  const float log_rest = 2 * s * (1 + square * (1.0F / 3 + square * (1.0F / 5 + square * (1.0F / 7))));
  constexpr float log_2 = 0.69314718F;
  return std::max(0x1p-25F, (24 - exponent) * log_2 - log_rest);
}

/// The sum of four uniform numbers, the bytes of one word.
AEOLIAN_INLINE float bell(std::uint32_t word) {
  const std::uint32_t pairs = (word & 0x00FF00FFU) + (word >> 8 & 0x00FF00FFU);
  const auto sum = static_cast<std::int32_t>((pairs & 0xFFFFU) + (pairs >> 16));
  constexpr float standard_deviation = 147.8F;  // sqrt(4 (256^2 - 1) / 12)
  return static_cast<float>(sum - 510) / standard_deviation;
}

}  // namespace

AEOLIAN_KERNEL void EjectionDraws::refill() {
  for (std::size_t i = 0; i < count; ++i) {
    const Philox::Block words = philox_(drawn_ + i, 1);
    gap_[i] = exponential(words[0]);
    length_[i] = exponential(words[1]);
    across_[i] = bell(words[2]);
    ways_[i] = words[3];
  }
  drawn_ += count;
  used_ = 0;
}

}  // namespace aeolian
