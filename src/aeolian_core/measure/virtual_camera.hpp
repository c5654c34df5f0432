#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// A straightedge over the bed, seen from above, that casts a shadow (Werner 1987, ch. V).
struct Straightedge {
  Eigen::Vector3d start = Eigen::Vector3d::Zero();  ///< ends of the casting edge, map frame [m]
  Eigen::Vector3d end = Eigen::Vector3d::UnitX();
  double width = 0.03;  ///< of the top face, on the light's side of the casting edge [m]
};

/// A pinhole camera without distortion: the forward model of a photograph of a straight shadow.
struct VirtualCamera {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  ///< camera (z forward, x right, y down) to map
  int width_px = 1600;
  int height_px = 1200;
  double focal_px = 1600;        ///< principal point at the picture's centre
  double sun_diameter = 0.0093;  ///< angular, for the penumbra [rad]
  double noise = 0.01;           ///< standard deviation of a pixel, of full scale

  /// An 8-bit grey photograph (sRGB curve), row by row, of a bed under `light` (unit vector, the way the
  /// light travels, downwards). The bed is grainy (albedo varies over `grain_diameter`), lit by its slope;
  /// the edge's shadow has its penumbra.
  std::vector<std::uint8_t> photograph(const HeightMap& bed, const Straightedge& edge,
                                       const Eigen::Vector3d& light, double grain_diameter,
                                       std::uint64_t seed) const;
};

}  // namespace aeolian
