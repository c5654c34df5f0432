#pragma once

#include <vector>

#include <Eigen/Core>

#include "aeolian_core/measure/camera_model.hpp"

namespace aeolian {

/// The lens of a CameraModel, written apart from the measuring code so that one can judge the other.
class Lens {
 public:
  explicit Lens(const CameraModel& camera) : camera_(camera) {}

  /// Where the direction (x, y, 1) is seen [px].
  Eigen::Vector2d pixel(const Eigen::Vector2d& direction) const;
  /// The direction (x, y, 1) seen in a pixel, by Newton's method to 1e-12; `guess` is where it starts.
  Eigen::Vector2d direction(const Eigen::Vector2d& pixel, const Eigen::Vector2d& guess) const;
  Eigen::Vector2d direction(const Eigen::Vector2d& pixel) const;
  /// The directions seen along the row at height y, in every pixel from -1 to width: width + 2 values.
  std::vector<Eigen::Vector2d> row(double y) const;
  /// The least slope of the distortion over the frame: below 0 it folds back. 1 without distortion.
  double least_slope() const;

 private:
  Eigen::Vector2d distort(const Eigen::Vector2d& undistorted) const;
  Eigen::Matrix2d slope(const Eigen::Vector2d& undistorted) const;

  CameraModel camera_;
};

}  // namespace aeolian
