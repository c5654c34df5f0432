#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/slide/surrogate/pile_table.hpp"

namespace aeolian {

/// From least to most.
struct Range {
  double low = 0;
  double high = 0;
};

/// Panels to simulate.
struct PileDesign {
  Range panel_length{0.5, 4};          ///< [m], evenly in its logarithm: short panels differ most
  Range panel_height{1, 4};            ///< [m]
  Range tilt{0.69813170, 1.22173048};  ///< [rad]
  Range thickness{0.05, 0.05};         ///< [m]
  int runs = 60;
  std::uint64_t seed = 1;
};

/// The corners of the ranges, so that all between them is inside the convex hull, and a Latin hypercube of
/// the other runs: each range is cut into as many parts as there are such runs, and each part is met once. A
/// range without width is held. Throws Error for a range that is not possible and for fewer runs than
/// corners.
std::vector<PileQuery> panels_of(const PileDesign& design);

}  // namespace aeolian
