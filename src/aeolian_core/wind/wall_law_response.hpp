#pragma once

#include "aeolian_core/wind/spectral_wind.hpp"
#include "aeolian_core/wind/terrain_response.hpp"
#include "aeolian_core/wind/wind_volume.hpp"

namespace aeolian {

/// The stress under a wind of the air, by the law of the wall from its velocity at a height over the ground
/// [m], at least 20 roughness lengths, and separated air behind steep lees as LeeBubble tells it. `relief` is
/// that of the surface.
TerrainResponse wall_law_response(const HeightMap& surface, const WindRelief& relief,
                                  const WindVolume& volume, double direction, const ReliefSettings& settings,
                                  double height);

}  // namespace aeolian
