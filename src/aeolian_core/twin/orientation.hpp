#pragma once

#include "aeolian_core/measure/shadow_profile.hpp"
#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Which way ripples face: the normal of their crests, within 90 degrees of `direction`, counter-clockwise
/// from east [rad], from the structure tensor of the surface (Bigun & Granlund 1987, ICCV, 433-438) averaged
/// to some twenty cells in `wavelength` [m]. White noise lengthens no direction and does not turn it. The
/// standard error is that of the jackknife over eight strips across the map's longer side. NaN when the
/// surface is less than a tenth steeper one way than the other, or less than four cells wide.
Figure crest_normal(const GridGeometry& geometry, const HeightMap::Layer& elevation, double wavelength,
                    double direction);

}  // namespace aeolian
