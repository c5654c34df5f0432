#pragma once

#include <cstddef>

#include <tbb/parallel_for.h>

namespace aeolian::sph {

/// Four floats that are computed at once: what a particle has, kept together so that a neighbour costs one
/// load.
using Four = float __attribute__((vector_size(16)));

inline float dot3(const Four& a, const Four& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
/// A mirror's other side: a less twice its part along the unit normal n, whose fourth number is zero.
inline Four mirrored(const Four& a, const Four& n) { return a - (2 * dot3(a, n)) * n; }

constexpr std::size_t chunk_size = 512;
inline std::size_t chunks_of(std::size_t n) { return (n + chunk_size - 1) / chunk_size; }

/// Calls work(chunk, first, end) for parts of n that do not depend on the number of threads: sums over each
/// of them, added in their order, are the same bits for any number.
template <class Work>
void for_chunks(std::size_t n, Work&& work) {
  tbb::parallel_for(std::size_t{0}, chunks_of(n), [&](std::size_t c) {
    work(c, c * chunk_size, n < (c + 1) * chunk_size ? n : (c + 1) * chunk_size);
  });
}

}  // namespace aeolian::sph
