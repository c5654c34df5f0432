#pragma once

#include <optional>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The waves that make up most of a map's relief, as far as a filter needs to know them: to some percent.
struct RipplePattern {
  double wavelength = 0;  ///< square to the crests [m]
  double normal = 0;      ///< square to the crests, within 60 degrees of the direction asked for [rad]
};

/// Standard deviation of the part of a layer that does not go on from cell to cell [m]: the median size of
/// the mixed second difference over 3 x 3 known cells (J. Immerkaer 1996, Computer Vision and Image
/// Understanding 64, 300-302), which a surface that bends along one direction only does not show. NaN without
/// nine known cells side by side.
double cell_noise(const GridGeometry& geometry, const HeightMap::Layer& elevation);

/// The dominant waves of a level layer without unknown cells, `noise` its standard deviation from cell to
/// cell. They are where the power density times wavenumber is highest: between 5 cells and two fifths of the
/// map, at no more than 60 degrees to `direction`, the mean over the peak. Nothing when they have less
/// variance than twice what the noise has in their band.
std::optional<RipplePattern> find_pattern(const GridGeometry& geometry, const HeightMap::Layer& level,
                                          double direction, double noise);

}  // namespace aeolian
