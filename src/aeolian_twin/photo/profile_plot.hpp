#pragma once

#include <string>

#include "aeolian_twin/photo/measured_photo.hpp"

namespace aeolian {

/// Draws the profile with its 95 % band, ripples and common tangents, and the slopes below, into an SVG file.
void plot_profile(const MeasuredPhoto& photo, const std::string& path);

}  // namespace aeolian
