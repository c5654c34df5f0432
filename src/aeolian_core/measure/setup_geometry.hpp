#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/measure/photo.hpp"
#include "aeolian_core/measure/photo_geometry.hpp"
#include "aeolian_core/measure/photo_setup.hpp"
#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// Scale and pose of a photo, from its setup.
struct SetupGeometry {
  std::shared_ptr<const PhotoGeometry> geometry;
  std::optional<CameraPose> pose;  ///< in full mode
  int side = 0;                    ///< where the shadow falls, 0: the marks do not say
  double middle = 0;               ///< x of the middle of the marks [m]
  double scale_sigma = 0;          ///< relative standard error of lengths on the top face
  std::vector<Eigen::Vector2d> mark_px;
  std::vector<std::string> remarks;
};

/// Throws Error as measure_shadow does for what concerns the camera, the marks and the edge. `known` is the
/// pose from tf, straightedge frame to camera frame.
SetupGeometry setup_geometry(const Photo& photo, const PhotoSetup& setup, ProfileMode mode,
                             const std::optional<Eigen::Isometry3d>& known);

}  // namespace aeolian
