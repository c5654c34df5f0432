#pragma once

#include <vector>

#include "aeolian_core/measure/photo.hpp"
#include "aeolian_core/measure/photo_setup.hpp"
#include "aeolian_core/measure/plane_pose.hpp"

namespace aeolian {

/// The corners of the strip's markers on a photo, good to a few hundredths of a pixel: each side of a black
/// square is a line through the places of half light across it, a corner is where two sides meet. (Finders of
/// corner-like texture pull the corner of a blurred square inwards.) Markers that the setup does not list are
/// ignored. Throws Error naming the dictionary when OpenCV has no such, or when no listed marker is seen.
std::vector<PlanePoint> find_markers(const Photo& photo, const PhotoSetup::Markers& markers);

}  // namespace aeolian
