#pragma once

#include <optional>
#include <vector>

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"
#include "aeolian_core/bedforms/height_map/wind_frame.hpp"

namespace aeolian {

/// How far sand on hard ground and what it asks of its surroundings reach within a step, in cells.
class SandReach {
 public:
  /// `direction` is that of the wind [rad], `hop` the mean reptation length [m], `aside` how many rows grains
  /// spread across, `tangent` that of the shallowest impacts.
  SandReach(const GridGeometry& geometry, double direction, double hop, int aside, double tangent);

  /// The cells, with some to spare, that sand may reach from where it lies now, and those upwind that may
  /// shade it; nothing where there is no sand that can move. Heights, hard floor and dune surface [m].
  std::optional<CellRange> range(const std::vector<double>& height, const std::vector<double>& floor,
                                 const std::vector<double>& dune) const;

  /// Whether sand cannot leave a part of the frame within a step.
  bool stays_within(const WindFrame& part, const ActivePatches& sandy) const;

 private:
  GridGeometry geometry_;
  double drop_;      ///< of a grain over a cell [m]
  double downwind_;  ///< in a step
  double aside_;
  double along_x_, along_y_;  ///< the wind's direction
};

}  // namespace aeolian
