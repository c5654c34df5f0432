#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/surface/point_cloud.hpp"

namespace aeolian {

/// A point in true coordinates, in the cloud's frame [m].
inline Eigen::Vector3d true_point(const PointCloud& cloud, std::size_t i) {
  return {cloud.origin_x + static_cast<double>(cloud.x[i]), cloud.origin_y + static_cast<double>(cloud.y[i]),
          cloud.origin_z + static_cast<double>(cloud.z[i])};
}

/// Throws Error, beginning with `what`, for coordinates of different counts and for a pose that is not
/// finite.
void require_usable(const PointCloud& cloud, const Eigen::Isometry3d& pose, const std::string& what);

/// Finite points of a cloud in the map frame for which `wanted` holds: all of them, or one at random from
/// each of at most `most` runs of equal length along the cloud, the same ones each time. Throws Error
/// as require_usable does.
std::vector<Eigen::Vector3d> sample_of(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                       std::size_t most, const std::string& what,
                                       const std::function<bool(const Eigen::Vector3d&)>& wanted);

/// Takes the mean of some points off them and returns it; zero of none.
Eigen::Vector3d centred(std::vector<Eigen::Vector3d>& points);

}  // namespace aeolian
