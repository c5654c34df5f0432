#pragma once

#include <vector>

#include "shadow_scene.hpp"
#include <Eigen/Geometry>
#include <opencv2/core.hpp>

namespace aeolian {

/// The straightedge's top face: matte grey, with a strip of paper under the markers, and the scale marks.
class BarFace {
 public:
  explicit BarFace(const ShadowScene& scene);

  /// Albedo at a point of the face [m].
  double albedo(const Eigen::Vector2d& point) const;

  /// Whether the albedo is surely the same within `reach` of a point.
  bool plain(const Eigen::Vector2d& point, double reach) const;

  static constexpr double metal = 0.24;

 private:
  struct Printed {
    Eigen::Vector2d corner;  ///< least x and y [m]
    cv::Mat modules;         ///< 0 black, 255 white; first row at the largest y
  };
  static constexpr double paper = 0.42;  // dusty: not so much brighter than the sand that it clips
  static constexpr double ink = 0.03;
  static constexpr double tick_radius = 0.00025;  // m

  double size_ = 0;
  std::vector<Printed> printed_;        // by x
  std::vector<Eigen::Vector2d> ticks_;  // by x
  Eigen::AlignedBox2d strip_;
};

}  // namespace aeolian
