#pragma once

#include <array>
#include <cstdint>

namespace aeolian {

/// Counter-based random numbers: Philox4x32-10 of Salmon et al. (2011), "Parallel random numbers: as easy as
/// 1, 2, 3".
///
/// A number is a pure function of (seed, stream, counter), so a result does not depend on the order in which,
/// or the number of threads by which, the numbers are drawn.
///
///     Philox random(seed);
///     auto bits = random(counter, stream);          // four independent 32-bit words
class Philox {
 public:
  using Block = std::array<std::uint32_t, 4>;

  explicit Philox(std::uint64_t seed)
      : key_{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)} {}

  Block operator()(std::uint64_t counter, std::uint64_t stream = 0) const {
    Block x{static_cast<std::uint32_t>(counter), static_cast<std::uint32_t>(counter >> 32),
            static_cast<std::uint32_t>(stream), static_cast<std::uint32_t>(stream >> 32)};
    std::uint32_t k0 = key_[0];
    std::uint32_t k1 = key_[1];
    for (int round = 0; round < 10; ++round) {
      const std::uint64_t p0 = std::uint64_t{0xD2511F53} * x[0];
      const std::uint64_t p1 = std::uint64_t{0xCD9E8D57} * x[2];
      x = {static_cast<std::uint32_t>(p1 >> 32) ^ x[1] ^ k0, static_cast<std::uint32_t>(p1),
           static_cast<std::uint32_t>(p0 >> 32) ^ x[3] ^ k1, static_cast<std::uint32_t>(p0)};
      k0 += 0x9E3779B9;
      k1 += 0xBB67AE85;
    }
    return x;
  }

 private:
  std::array<std::uint32_t, 2> key_;
};

/// One stream of a Philox generator, drawn in sequence.
class RandomStream {
 public:
  RandomStream(std::uint64_t seed, std::uint64_t stream) : philox_(seed), stream_(stream) {}

  std::uint32_t bits() {
    if (used_ == 4) {
      block_ = philox_(counter_++, stream_);
      used_ = 0;
    }
    return block_[used_++];
  }
  /// Uniform in the open interval (0, 1).
  double uniform() { return (static_cast<double>(bits()) + 0.5) * 0x1p-32; }
  /// Exponential with mean 1.
  double exponential();
  /// Standard normal (Box-Muller).
  double normal();

 private:
  Philox philox_;
  std::uint64_t stream_;
  std::uint64_t counter_ = 0;
  Philox::Block block_{};
  unsigned used_ = 4;
};

}  // namespace aeolian
