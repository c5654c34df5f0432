#pragma once

#include <optional>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The plane a + b x + c y about the middle of a grid, x and y in cells.
struct Plane {
  double a = 0;
  double b = 0;
  double c = 0;
};

/// The plane of least squares through the known cells; through fewer than three of them, or cells in one
/// line, a level one at their mean.
Plane fit_plane(const GridGeometry& geometry, const HeightMap::Layer& elevation);

/// A layer, less a plane, resampled to parallel lines along a direction: bilinear, a sample per cell. Lines
/// are skipped evenly where a map has more than some 260 000 cells, which bounds the cost of what is done
/// with them.
struct DirectionalLines {
  int count = 0;             ///< of lines
  int spacing = 1;           ///< of lines [cells]
  int length = 0;            ///< samples in each
  std::vector<float> value;  ///< line by line, 0 where unknown
  std::vector<float> known;  ///< 1 or 0

  DirectionalLines(const GridGeometry& geometry, const HeightMap::Layer& elevation, const Plane& plane,
                   double direction);
  std::size_t start(int line) const {
    return static_cast<std::size_t>(line) * static_cast<std::size_t>(length);
  }
};

/// Correlation coefficient of earlier(x) with later(x + lag), lag in samples, over the pairs of which both
/// are known; nothing when those are fewer than a twentieth of all samples or one side does not vary. Both
/// have the same shape.
std::optional<double> correlation(const DirectionalLines& earlier, const DirectionalLines& later, int lag);

}  // namespace aeolian
