#pragma once

#include "shadow_scene.hpp"
#include <Eigen/Geometry>

namespace aeolian {

/// The part of a uniform disc of radius 1 that lies below the line at height `offset`.
double disc_below(double offset);

/// What the straightedge, taken as a solid box, and the post on it leave of the light that reaches a point
/// below them. Points are in the straightedge frame [m].
class BarShadow {
 public:
  explicit BarShadow(const ShadowScene& scene);

  /// How the box stands in the sky over a point. Seen from there along the box, its section is four corners;
  /// what counts is the angle between the light and the planes through the point and the long edges.
  struct Sky {
    struct Section {  ///< unit vectors to its corners
      Eigen::Array4d sideways;
      Eigen::Array4d up;
    };
    Section across;               ///< in (y, z)
    Section along;                ///< in (x, z)
    double nearest = 0;           ///< distance to the nearest corner [m]
    double blocked_skylight = 0;  ///< share of the sky's light that the box keeps away
  };
  Sky sky(const Eigen::Vector3d& point) const;

  /// Signed angles [rad] of the light's centre over the box's upper silhouette and under its lower one (both
  /// negative in the full shadow), and outwards past its nearer end.
  struct Angles {
    double past_edge = 0;
    double past_end = 0;
  };
  Angles angles(const Sky& sky, const Eigen::Vector3d& to_light) const;

  /// Share of the disc around the unit vector `to_light` that is seen past the box.
  double seen_past_box(const Sky& sky, const Eigen::Vector3d& to_light) const;
  /// Share of the disc that is seen past the post, from a point.
  double seen_past_post(const Eigen::Vector3d& point, const Eigen::Vector3d& to_light) const;

  /// Whether the post's shadow may come within `reach` [m] of a point.
  bool near_post(const Eigen::Vector3d& point, const Eigen::Vector3d& to_light, double reach) const;

  static constexpr double post_radius = 0.00075;  // m

 private:
  struct Past {
    double over;
    double under;
  };
  static Past past(const Sky::Section& section, double light_sideways, double light_up);

  Eigen::Vector3d low_;  // corners of the box
  Eigen::Vector3d high_;
  double disc_;         // angular radius
  double post_height_;  // 0: no post
  double post_x_;
};

}  // namespace aeolian
