#pragma once

#include <string>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Names of terrains that hard_terrain() makes.
const std::vector<std::string>& terrain_names();

/// Hard ground [m] of a name: flat; hump, steep_hump and dune, Gaussians of 0.15 lengths, 0.05, 0.15 and 0.08
/// lengths high (the dune 0.25 wide); valley, a sine of 0.03 lengths across the wind (Szabo 2019, chapter 4;
/// heights are the specification's); stakes, nine square posts of two cells; step, half of it 0.05 lengths
/// higher; crags, three round rocks 0.018 lengths high. The valley and the step run along x and y. Throws
/// Error for another name.
HeightMap hard_terrain(const std::string& name, const GridGeometry& geometry);

/// Adds the layer `elevation`: loose material on the layer `ground`, uneven by a grain's diameter [m]. With a
/// cover below 1 it lies in round heaps of parabolic height instead, `heap` [m] in radius, that cover so much
/// of the ground; the depth is that of their middle.
struct LooseCover {
  double depth = 0.075;  ///< [m]
  double share = 1;
  double heap = 0.5;  ///< [m]
};
void cover(HeightMap& map, const LooseCover& loose, double grain_diameter, std::uint64_t seed);

}  // namespace aeolian
