#pragma once

#include <array>

#include <Eigen/Core>

namespace aeolian {

/// A calibrated camera: a pinhole with the lens distortion of `sensor_msgs/CameraInfo`.
///
/// Camera frame: x right, y down, z forward; the centre of the upper left pixel is (0, 0). With k4 = k5 = k6
/// = 0 this is the model `plumb_bob`, otherwise `rational_polynomial` (both as in Brown 1966 and OpenCV).
struct CameraModel {
  int width_px = 0;
  int height_px = 0;
  double fx = 0;  ///< focal lengths and principal point [px]
  double fy = 0;
  double cx = 0;
  double cy = 0;
  std::array<double, 8> distortion{};  ///< k1, k2, p1, p2, k3, k4, k5, k6

  /// Where a point in front of the camera (z > 0, any length unit) is seen [px]; NaN beyond the radius at
  /// which the distortion folds back.
  Eigen::Vector2d pixel(const Eigen::Vector3d& point) const;
  /// The direction (z = 1) that is seen in a pixel, good to 1e-9 px. Throws Error where the distortion cannot
  /// be undone: beyond the radius at which the model folds back.
  Eigen::Vector3d ray(const Eigen::Vector2d& pixel) const;
};

}  // namespace aeolian
