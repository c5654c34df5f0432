#pragma once

#include <vector>

#include <Eigen/Geometry>

namespace aeolian {

/// A point of a cloud and the plane that it should lie on, about an origin near both.
struct PointOnPlane {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;      ///< unit
  double residual = 0;         ///< distance from the plane, positive on the normal's side [m]
  double normal_variance = 0;  ///< of the normal's direction [rad^2]
};

/// The small rigid moves that a set of planes can tell: columns are orthonormal twists (translation [m],
/// rotation times `arm` [m]) of cloud points about the origin.
struct HeldDirections {
  Eigen::Matrix<double, 6, Eigen::Dynamic> basis;
  double arm = 1;  ///< root mean square distance of the points from the origin [m]
};

/// The directions along which the surface holds the cloud. Along an eigenvector of the normal equations of
/// point-to-plane the distances from the planes change by sqrt(eigenvalue) per metre: about 1 for a lift, the
/// rms slope of the relief for a slide, next to nothing for a slide along a flat bed. Held is a direction
/// with more than `least_slope` and with twice what noise in the normals feigns: J. Zhang, M. Kaess, S. Singh
/// (2016), "On degeneracy of optimization-based state estimation problems", ICRA, 809-816.
HeldDirections held_directions(const std::vector<PointOnPlane>& pairs, double farthest, double least_slope);

/// One Gauss-Newton step of the cloud towards the planes within the held directions, by least squares with
/// biweights that end at `farthest` [m].
Eigen::Isometry3d step_to_planes(const std::vector<PointOnPlane>& pairs, double farthest,
                                 const HeldDirections& held);

/// The part of a small move about the origin that lies in the held directions.
Eigen::Isometry3d held_part(const Eigen::Isometry3d& move, const HeldDirections& held);

}  // namespace aeolian
