#pragma once

#include <string>

#include "aeolian_twin/terrain/wind_files.hpp"

namespace aeolian {

/// Draws speed_up.png: the shaded relief, coloured by what the wind gains or loses at the ground, with arrows
/// along streamlines (as long as the friction velocity is great) and separated air in grey.
void draw_speed_up(const TerrainWindRun& run, const std::string& folder);

}  // namespace aeolian
