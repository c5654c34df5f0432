#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "aeolian_core/measure/fixed_point.hpp"
#include "aeolian_core/measure/sensor_noise.hpp"

namespace aeolian {

/// What became of the points of a cloud.
struct PointCounts {
  std::size_t used = 0;
  std::size_t not_finite = 0;
  std::size_t out_of_range = 0;
  std::size_t outside = 0;

  void add(const PointCounts& other) {
    used += other.used;
    not_finite += other.not_finite;
    out_of_range += other.out_of_range;
    outside += other.outside;
  }
};

/// Takes points of a cloud to the map frame, finds their tile and cell and weighs them with the noise model:
/// plain arrays in, plain arrays out. Coordinates are double, so that large ones cancel.
struct PointLocator {
  static constexpr std::size_t batch = 256;
  static constexpr std::int32_t nowhere = -1;

  std::array<double, 9> rotation{};  ///< row by row
  std::array<double, 3> offset{};    ///< map frame minus the grid's origin (z: minus zero) [m]
  std::array<double, 3> origin{};    ///< of the cloud, in the sensor's frame [m]
  double per_cell = 1;               ///< cells per metre
  int nx = 0;
  int ny = 0;
  int tiles_x = 0;
  double nearest = 0;   ///< squared [m^2]
  double farthest = 0;  ///< squared [m^2]
  SensorNoise noise;
  double reference_variance = 1e-6;  ///< of a point with fixed::reference_weight [m^2]
  /// Seen from many places: no range limits, no rays; each height has the variance range_sigma^2.
  bool georeferenced = false;

  /// `count` <= batch points. For each, the tile (or `nowhere`) and the sample.
  PointCounts locate(const float* x, const float* y, const float* z, std::size_t count, std::int32_t* tile,
                     Sample* sample) const;
};

}  // namespace aeolian
