#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "aeolian_core/measure/point_to_plane.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The elevation of a map as a smooth surface that points can be laid on: in each cell the plane that touches
/// the least-squares quadratic of the 7 x 7 cells around it, and between the centres of cells the bilinear
/// mixture of their planes. Seven cells quiet the slope enough to tell ripples from noise, and still follow
/// ripples of ten cells' length.
///
/// A cell has no plane when fewer than half of those cells are known, and at edges: what is steeper than 60
/// degrees is no bed, and a direction that is uncertain by more than 0.3 rad is no plane. Planes are fitted
/// when they are asked for first. Points are about an origin near them, so that georeferenced ones fit
/// floats. Refers to the map, which must outlive it and not change.
class MapSurface {
 public:
  /// Throws Error when the map has no elevation.
  MapSurface(const HeightMap& map, const Eigen::Vector3d& origin);

  /// The surface under (or over) a point; nothing over an unknown cell or one without a plane.
  std::optional<PointOnPlane> under(const Eigen::Vector3d& point);
  /// The same of the points that are not farther than `max_distance` from it [m].
  std::vector<PointOnPlane> pairs(const std::vector<Eigen::Vector3d>& points, double max_distance);
  /// The known cells in a rectangle that holds the points with a margin [m], about the origin.
  std::vector<Eigen::Vector3d> cells_around(const std::vector<Eigen::Vector3d>& points, double margin) const;

  double cell() const { return geometry_.cell(); }

 private:
  enum class State : unsigned char { unasked, none, fitted };
  struct Plane {
    float height = 0;  ///< in the cell's centre [m]
    float slope_x = 0;
    float slope_y = 0;
    float normal_variance = 0;  ///< [rad^2]
    State state = State::unasked;
  };
  /// Null outside the map and where there is none.
  const Plane* plane(CellIndex cell);
  Plane fitted(CellIndex cell) const;

  const GridGeometry& geometry_;
  const HeightMap::Layer& elevation_;
  Eigen::Vector3d origin_;
  std::vector<Plane> planes_;
};

}  // namespace aeolian
