#pragma once

#include <vector>

#include "aeolian_core/measure/photo_geometry.hpp"
#include "aeolian_core/measure/tone.hpp"

namespace aeolian {

/// Share of the stations beside whose border another one runs within 8 mm, as a second light makes it: the
/// light just outside a border should be that of the bed further out, and just inside that of the depth of
/// the shadow. `gap` [m] is what the border's own blur takes on either side.
double share_with_second_border(const Tone& tone, const PhotoGeometry& geometry,
                                const std::vector<Eigen::Vector2d>& terminus, int side, double gap,
                                double pixel_size);

}  // namespace aeolian
