#pragma once

#include <cstdint>

#include <Eigen/Geometry>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"

namespace aeolian {

/// A scanner on a tripod that sweeps a fan of rays over the surface: the forward model of a range sensor.
struct VirtualScanner {
  Eigen::Isometry3d pose =
      Eigen::Isometry3d::Identity();  ///< sensor to map; rays leave about the sensor's +z axis
  int columns = 500;                  ///< rays across (about the sensor's y axis)
  int rows = 300;                     ///< rays along (about the sensor's x axis)
  double field_of_view_x = 1.0;       ///< full angle across [rad]
  double field_of_view_y = 0.6;       ///< full angle along [rad]
  double range_sigma = 0.0006;        ///< noise along the ray [m]
  double dropout = 0.02;              ///< share of rays that return nothing

  /// What the scanner sees of a map's elevation: an organised cloud (row by row) in sensor coordinates, NaN
  /// for rays that drop out or miss. Rays meet the bilinear surface, so that crests hide what lies behind
  /// them (occlusion). Each scan starts at another fraction of a step, as a sweeping head does, so that no
  /// cell is passed over for ever. That and the noise are functions of (seed, scan, ray) alone. Throws Error
  /// naming a property that cannot be.
  PointCloud scan(const HeightMap& truth, std::uint64_t seed, std::uint64_t scan_number) const;
};

}  // namespace aeolian
