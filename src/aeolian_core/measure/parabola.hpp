#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace aeolian {

/// An extremum between equidistant samples.
struct Vertex {
  double position = 0;   ///< in samples from the first of the vector
  double value = 0;      ///< there
  double curvature = 0;  ///< second derivative, per sample squared
};

/// Vertex of the least-squares parabola through samples first..last (both included, at least three); nothing
/// when it has none among them.
std::optional<Vertex> parabola_vertex(const std::vector<double>& values, std::size_t first, std::size_t last);

/// The same with a cubic through at least four, for tops whose sides differ.
std::optional<Vertex> cubic_vertex(const std::vector<double>& values, std::size_t first, std::size_t last);

}  // namespace aeolian
