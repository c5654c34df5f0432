#pragma once

#include <cmath>

#include <Eigen/Core>

#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// An impact as the bed under it sees it: level, with the grain coming down forward.
///
/// A grain that falls onto a bed that rises steeply towards it, more than a right angle to the bed, moves
/// backward along that bed; the view turns about.
class BedView {
 public:
  explicit BedView(const Impact& impact) : angle_(impact.angle_to_bed()) {
    if (angle_ > M_PI / 2) {
      angle_ = M_PI - angle_;
      forward_ = -1;
    }
    if (impact.slope != 0) {
      cosine_ = std::cos(impact.slope);
      sine_ = std::sin(impact.slope);
    }
  }

  double angle() const { return angle_; }  ///< of the path to the bed, 0 to pi / 2 [rad]

  /// A velocity along the bed and away from it, in the frame of the flight.
  Eigen::Vector3d velocity(double along, double away, double across = 0) const {
    return {forward_ * along * cosine_ - away * sine_, forward_ * across,
            forward_ * along * sine_ + away * cosine_};
  }

  /// The other way about: along the bed, across and away from it, of a velocity in the frame of the flight.
  Eigen::Vector3d on_bed(const Eigen::Vector3d& velocity) const {
    return {forward_ * (velocity.x() * cosine_ + velocity.z() * sine_), forward_ * velocity.y(),
            velocity.z() * cosine_ - velocity.x() * sine_};
  }
  /// A distance along the flight as one along the grain's way on the bed, and back.
  double along(double distance) const { return forward_ * distance; }

 private:
  double angle_;
  double forward_ = 1;
  double cosine_ = 1;
  double sine_ = 0;
};

}  // namespace aeolian
