#pragma once

#include <optional>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/measure/camera_model.hpp"

namespace aeolian {

/// A point of the straightedge's top face and where it was seen.
struct PlanePoint {
  Eigen::Vector2d position;  ///< x, y in the straightedge frame, z = 0 [m]
  Eigen::Vector2d pixel;
  bool found = false;  ///< by the program, not given by a person: left out where it does not agree
};

/// A camera in its place.
struct CameraPose {
  CameraModel camera;
  Eigen::Isometry3d to_camera = Eigen::Isometry3d::Identity();  ///< straightedge frame to camera frame
  double rms_px = 0;                                            ///< of the points about the fit
  /// Standard errors and correlations of: small rotation (x, y, z, applied after the pose) [rad], translation
  /// [m], log of the focal length.
  Eigen::Matrix<double, 7, 7> covariance = Eigen::Matrix<double, 7, 7>::Zero();

  /// The same, moved by small parameters in the order of `covariance`.
  CameraPose moved(const Eigen::Matrix<double, 7, 1>& by) const;
  Eigen::Vector2d pixel(const Eigen::Vector3d& point) const { return camera.pixel(to_camera * point); }
};

/// What is believed of a focal length before the points are looked at.
struct FocalPrior {
  double focal_px = 0;
  double relative_sigma = 0;  ///< 0: it is known
};

/// The pose of a camera that sees points of a plane, by least squares; with a prior that is not exact, the
/// focal length is fitted too. The covariance comes from the residuals, but from no less than 0.02 px. Throws
/// Error when the points are fewer than four, lie on one line, are seen from below, or one is farther than
/// 3 px (and five robust deviations) from where the others put it: "marks disagree".
CameraPose fit_pose(const std::vector<PlanePoint>& points, const CameraModel& camera,
                    const FocalPrior& prior);

}  // namespace aeolian
