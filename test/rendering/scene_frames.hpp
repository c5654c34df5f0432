#pragma once

#include "shadow_scene.hpp"
#include <Eigen/Geometry>

namespace aeolian {

/// Level frame to straightedge frame: both have the same origin and y axis.
inline Eigen::Matrix3d level_to_straightedge(const ShadowScene& scene) {
  return Eigen::AngleAxisd(scene.inclination, Eigen::Vector3d::UnitY()).toRotationMatrix();
}

/// The unit vector, in the level frame, towards a source at an azimuth given as in PhotoSetup::Angles.
inline Eigen::Vector3d to_light(const ShadowScene& scene, double azimuth) {
  return {-std::cos(scene.elevation) * std::sin(azimuth),
          -scene.shadow_side * std::cos(scene.elevation) * std::cos(azimuth), std::sin(scene.elevation)};
}

}  // namespace aeolian
