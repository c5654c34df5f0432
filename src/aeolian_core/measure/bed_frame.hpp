#pragma once

#include <Eigen/Geometry>

#include "aeolian_core/surface/point_cloud.hpp"

namespace aeolian {

/// The frame of a bed, as its pose in the map frame (bed to map), from a cloud of points of it: z is the
/// upward normal (the one nearest to the map's z) of the plane that fits most points best, x the map's x
/// projected onto that plane, the origin on it in the middle of its points.
///
/// Least median of squares (PCL) finds the plane without a threshold, as long as fewer than half of the
/// points lie off the bed; weighted least squares (biweights) then uses all that lie on it, ripples included.
/// Of large clouds 20000 points are used, drawn evenly along them. The result depends on the inputs alone.
///
/// Throws Error for a pose that is not finite, for coordinates of different counts, for fewer than 10 finite
/// points or points on a line, and for a plane steeper than 80 degrees.
Eigen::Isometry3d fit_bed_frame(const PointCloud& cloud, const Eigen::Isometry3d& sensor_to_map);

}  // namespace aeolian
