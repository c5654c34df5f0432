#pragma once

#include <vector>

#include "aeolian_core/measure/photo_geometry.hpp"
#include "aeolian_core/measure/photo_setup.hpp"

namespace aeolian {

/// The direction of light of a photo whose shadow ends at the pixels `terminus`.
///
/// A post's shadow tip lies on the bed, whose height there is taken from the shadow's own end at the same x
/// (Werner's assumption that the bed does not change along the crests over the length of a shadow): the
/// direction and that height are found together. Throws Error when the sun was down or on the other side,
/// when the light is above 85 or below 3 degrees, and when a post's tip does not lie in its light.
Light find_light(const PhotoSetup& setup, const PhotoGeometry& geometry, int side,
                 const std::vector<Eigen::Vector2d>& terminus);

}  // namespace aeolian
