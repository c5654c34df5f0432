#pragma once

#include <Eigen/Core>

#include "aeolian_core/bedforms/erosion/erosion_parameters.hpp"

namespace aeolian {

/// What an impact does.
struct BounceResult {
  bool captured = false;
  Eigen::Vector3f velocity{0, 0, 0};  ///< of the rebound [m/s]
  float pushed = 0;  ///< grains that it would set moving in loose grains, for each of its own
};

/// The impact of a velocity [m/s], x and y along the grid's axes, on a bed of the given slopes eastwards and
/// northwards (specification sec. 2.5). `drawn`: uniform in (0, 1). `unit`: sqrt(g d) [m/s]. One that does
/// not fall towards the mean slope, as before a step, grazes it.
BounceResult bounced(const Bounce& bounce, const Eigen::Vector3f& velocity, float slope_x, float slope_y,
                     float unit, float drawn);

}  // namespace aeolian
