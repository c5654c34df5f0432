#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <vector>

#include <benchmark/benchmark.h>

namespace aeolian::bench {

/// What memory allows here and now: the quickest of several plain copies of 64 MiB.
inline double seconds_to_copy_a_byte() {
  std::vector<char> from(std::size_t{64} << 20, 1);
  std::vector<char> to(from.size());
  double best = 1;
  for (int i = 0; i < 8; ++i) {
    const auto start = std::chrono::steady_clock::now();
    std::memcpy(to.data(), from.data(), from.size());
    benchmark::ClobberMemory();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    best = std::min(best, taken.count() / static_cast<double>(from.size()));
  }
  return best;
}

}  // namespace aeolian::bench
