#pragma once

#include <cstdint>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// A random field of mean 0 and standard deviation 1 at every cell of a grid, alike over `length` [m]: cubic
/// B-splines over independent normal numbers on a lattice of that spacing, scaled to one variance everywhere.
/// The correlation is a half at one length, a twentieth at two and zero from four on. Decided by seed and
/// stream; lengths below a cell are taken as a cell.
HeightMap::Layer smooth_noise(const GridGeometry& geometry, double length, std::uint64_t seed,
                              std::uint64_t stream);

}  // namespace aeolian
