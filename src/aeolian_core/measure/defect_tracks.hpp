#pragma once

#include <vector>

#include "aeolian_core/measure/ripple_tracking.hpp"

namespace aeolian {

/// Follows the ends of crests from map to map: the nearest to where the pattern carries it that opens to the
/// same side, within three quarters of a wavelength. Those seen on one map only are left out.
std::vector<DefectTrack> follow_defects(const std::vector<TrackedMap>& maps);

}  // namespace aeolian
