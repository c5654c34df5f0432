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

/// Inverse of a symmetric matrix given by its columns; false, and nothing done, where its determinant is not
/// more than `least`.
inline bool invert(const Four* m, float least, Four* inverse) {
  const float a = m[0][0];
  const float b = 0.5F * (m[0][1] + m[1][0]);
  const float c = 0.5F * (m[0][2] + m[2][0]);
  const float d = m[1][1];
  const float e = 0.5F * (m[1][2] + m[2][1]);
  const float f = m[2][2];
  const float u = d * f - e * e;
  const float v = c * e - b * f;
  const float w = b * e - c * d;
  const float determinant = a * u + b * v + c * w;
  if (!(determinant > least)) return false;
  const float by = 1 / determinant;
  inverse[0] = Four{u * by, v * by, w * by, 0};
  inverse[1] = Four{v * by, (a * f - c * c) * by, (b * c - a * e) * by, 0};
  inverse[2] = Four{w * by, (b * c - a * e) * by, (a * d - b * b) * by, 0};
  return true;
}

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
