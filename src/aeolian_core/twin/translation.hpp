#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// A surface moved as a whole.
struct Translation {
  double shift = 0;  ///< along the direction [m]
  double rmse = 0;   ///< between the moved surface and the target, over the cells known in both [m]
};

/// The pure translation of `start` along `direction` [rad] within +-max_shift [m] that comes nearest to
/// `target`: values between cells are bilinear, and shifts that leave fewer than half of the cells are not
/// considered. The shift is found to a hundredth of a cell; a shift of zero is always among those tried, and
/// takes the values as they are.
Translation best_translation(const GridGeometry& geometry, const HeightMap::Layer& start,
                             const HeightMap::Layer& target, double direction, double max_shift);

}  // namespace aeolian
