#pragma once

#include <vector>

#include "ripple_bed.hpp"
#include "shadow_scene.hpp"

namespace aeolian {

/// Where a scene's shadow and straightedge lie in its frame, by true projection.
struct SceneLayout {
  double from = 0;  ///< part of the straightedge along which its face and its shadow's far border are in the
  double to = 0;    ///< frame, and the border is cast by it [m]
  double least_gap_px = 0;    ///< between the border and the straightedge as seen
  double least_crossing = 0;  ///< sine of the angle between view and plane of light
  double least_view = 0;      ///< cosine of the angle between view and bed normal, along the border
};

/// Looks at x in [middle - reach, middle + reach]; `margin_px` keeps clear of the frame's border.
SceneLayout lay_out(const ShadowScene& scene, double middle, double reach, double margin_px);

/// Whether a pixel is in the frame and at least a margin from its border.
bool in_frame(const CameraModel& camera, const Eigen::Vector2d& pixel, double margin_px);

/// Light on the bed's facets over that on level ground: least and most over a rectangle around the middle.
std::pair<double, double> facet_light(const ShadowScene& scene, double middle, double reach);

}  // namespace aeolian
