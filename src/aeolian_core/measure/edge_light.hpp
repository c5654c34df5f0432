#pragma once

#include "aeolian_core/measure/photo_geometry.hpp"
#include "aeolian_core/measure/shadow_search.hpp"
#include "aeolian_core/measure/tone.hpp"

namespace aeolian {

/// Share of the straightedge's top face, in the millimetre beside its casting edge, that has less than a
/// third of the light of its bright part: little for a bar in the sun with its ticks, much where something
/// casts its shadow on it.
double shaded_share_of_edge(const Tone& tone, const PhotoGeometry& geometry, const EdgeSpan& span, int side);

}  // namespace aeolian
