#pragma once

#include <Eigen/Core>

#include "aeolian_core/bedforms/erosion/drift.hpp"
#include "aeolian_core/bedforms/erosion/surface_patch.hpp"

namespace aeolian {

/// Where a hop ends.
struct HopEnd {
  float x, y;  ///< [cells]; on the ring of a periodic bed
  Eigen::Vector3f velocity;
  float way;     ///< along the wind [cells]
  bool outside;  ///< beyond an open border
};

/// Looks up a hop from a place of the surface [cells] and follows its arc, two half parabolas, cell by cell
/// where the terrain may reach it: it ends on the terrain, higher or lower than it began.
HopEnd walk_hop(const ErodibleBed& bed, const HopTable& table, const Drift::Cell& wind, float x, float y,
                const Eigen::Vector3f& velocity);

}  // namespace aeolian
