#pragma once

#include <limits>
#include <optional>

#include <Eigen/Core>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Rays against the bilinear surface through the centres of a layer's cells; the outermost half cell is
/// level. What scanner and camera see of a map. Refers to the layer, which must outlive it.
class SurfaceRays {
 public:
  /// Throws Error when the layer does not fit the grid.
  SurfaceRays(const GridGeometry& geometry, const HeightMap::Layer& heights);

  struct Hit {
    double distance;  ///< along the ray, in lengths of its direction vector
    double slope_x;   ///< dh/dx of the surface there
    double slope_y;
  };
  /// The first meeting of a ray (map frame) with the upper side of the surface. Nothing for a ray that leaves
  /// the map, falls into an unknown patch, or starts or enters below the surface.
  std::optional<Hit> first_hit(const Eigen::Vector3d& start, const Eigen::Vector3d& direction) const;

 private:
  struct Patch;
  Patch patch(int i, int j) const;

  GridGeometry geometry_;
  const HeightMap::Layer& heights_;
  double lowest_ = std::numeric_limits<double>::infinity();
  double highest_ = -std::numeric_limits<double>::infinity();
};

}  // namespace aeolian
