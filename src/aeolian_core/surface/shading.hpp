#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// Red, green, blue, 0 to 255.
using Rgb = std::array<std::uint8_t, 3>;

enum class Palette {
  sand,       ///< sequential: dark brown, ochre, pale sand
  diverging,  ///< blue below zero, white at zero, red above zero
  viridis,    ///< sequential: dark blue, green, yellow (matplotlib's); for variance, age, counts
  grey,       ///< one light grey: the relief alone
};

/// The colour of a value in [0, 1]; values outside are clamped, NaN gives neutral grey.
Rgb colour(Palette palette, double value);

/// The range that a picture of a layer should show: the 2nd to 98th percentile of the known cells; for the
/// diverging palette symmetric about zero. (0, 0) when nothing is known.
struct ValueRange {
  double low = 0;
  double high = 0;
};
ValueRange display_range(const HeightMap::Layer& values, Palette palette);

/// Light reflected by ground of the given slopes (rise over run, eastwards and northwards) in [0, 1] under a lamp
/// in the north-west, 45 degrees high.
float reflected_light(float slope_east, float slope_north);

/// A colour under such light relative to that on flat ground, which keeps the colour as it is.
Rgb lit(const Rgb& colour, float light);

/// Light reflected by each cell in [0, 1] under a lamp in the north-west, 45 degrees high; heights are
/// exaggerated first. Unknown cells and those beside them count as flat.
std::vector<float> hill_shade(const GridGeometry& geometry, const HeightMap::Layer& elevation,
                              double exaggeration = 1);

/// The colour of each cell: the palette's, darkened by hill shading of `relief` (the layer itself when null).
std::vector<Rgb> shaded_colours(const GridGeometry& geometry, const HeightMap::Layer& values, Palette palette,
                                ValueRange range, const HeightMap::Layer* relief = nullptr,
                                double exaggeration = 1);

}  // namespace aeolian
