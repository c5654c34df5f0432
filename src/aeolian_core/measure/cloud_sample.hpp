#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/surface/point_cloud.hpp"

namespace aeolian {

/// Finite points of a cloud in the map frame for which `wanted` holds: all of them, or one at random from
/// each of at most `most` runs of equal length along the cloud, the same ones each time. Throws Error,
/// beginning with `what`, for coordinates of different counts and for a pose that is not finite.
std::vector<Eigen::Vector3d> sample_of(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                       std::size_t most, const char* what,
                                       const std::function<bool(const Eigen::Vector3d&)>& wanted);

/// Takes the mean of some points off them and returns it; zero of none.
Eigen::Vector3d centred(std::vector<Eigen::Vector3d>& points);

}  // namespace aeolian
