#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace aeolian {

/// Top (or bottom) of a parabola over equidistant samples.
struct ParabolaVertex {
  double position = 0;   ///< in samples from the first of the vector
  double value = 0;      ///< there
  double curvature = 0;  ///< second derivative, per sample squared
};

/// Vertex of the least-squares parabola through samples first..last (both included, at least three); nothing
/// when it is straight or its vertex lies outside of them.
std::optional<ParabolaVertex> fit_vertex(const std::vector<double>& values, std::size_t first,
                                         std::size_t last);

}  // namespace aeolian
