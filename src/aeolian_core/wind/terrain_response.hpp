#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// What relief does to a wind of one direction, whatever its speed: neutral flow is proportional to it.
/// Unknown where the elevation is.
struct TerrainResponse {
  GridGeometry geometry;
  HeightMap::Layer friction;    ///< friction velocity over that of the surroundings; zero in separated air
  HeightMap::Layer deflection;  ///< of the stress, counter-clockwise from the wind of the surroundings [rad]
  HeightMap::Layer separated;   ///< one in separated air, zero elsewhere
};

}  // namespace aeolian
