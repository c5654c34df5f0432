#pragma once

#include <vector>

#include "aeolian_core/measure/photo_geometry.hpp"
#include "aeolian_core/measure/tone.hpp"

namespace aeolian {

/// Where the shadow ends, roughly: y on the plane of the top face over x, both even steps.
struct RoughTerminus {
  int side = 1;               ///< the shadow lies at y > 0 (+1) or y < 0 (-1)
  double start = 0;           ///< x of the first column [m]
  double step = 0;            ///< of x [m]
  double row = 0;             ///< of the search across: what y is good to [m]
  std::vector<double> y;      ///< distance from the casting edge, positive [m]; NaN where there is none
  double shade = 0;           ///< median light of the shadow, linear
  std::vector<double> reach;  ///< distance from the casting edge to which a column was searched [m]
};

/// What part of the casting edge is on the photo.
struct EdgeSpan {
  double from = 0;  ///< x [m]
  double to = 0;
};

/// The stretch of the casting edge that is on the photo, walked from `seed`. Throws Error when less than
/// 40 px of it are.
EdgeSpan visible_edge(const PhotoGeometry& geometry, int width_px, int height_px, double seed);

/// Finds the border between the shadow beside the edge and the sunlit bed beyond it, on the given side or,
/// for side 0, on the side that has one. The border is the path across the photo that leaves the least light
/// on its inner and the least darkness on its outer side (dynamic programming on a coarse grid in linear
/// light). Throws Error with the reason when there is no such border, when a second one runs along it, when
/// it leaves the photo, or when the sunlit bed is over-exposed.
RoughTerminus search_shadow(const Tone& tone, int width_px, int height_px, const PhotoGeometry& geometry,
                            const EdgeSpan& span, int side);

}  // namespace aeolian
