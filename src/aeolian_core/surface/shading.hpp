#pragma once

#include <algorithm>
#include <array>
#include <cmath>
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

/// Light reflected by flat ground under a lamp 45 degrees high.
constexpr float flat_light = 0.70710678F;

/// The range that a picture of a layer should show: the 2nd to 98th percentile of the known cells; for the
/// diverging palette symmetric about zero, of values that are mostly zero up to the largest. (0, 0) when
/// nothing is known.
struct ValueRange {
  double low = 0;
  double high = 0;
};
ValueRange display_range(const HeightMap::Layer& values, Palette palette);

/// Light reflected by ground of the given slopes (rise over run, eastwards and northwards) in [0, 1] under a
/// lamp in the north-west, 45 degrees high. Inline, for loops that the compiler turns into vectors.
inline float reflected_light(float slope_east, float slope_north) {
  // Unit normal (-dx, -dy, 1) / |.| times the direction to the lamp (-1/2, 1/2, sin 45).
  const float towards = (0.5F * slope_east - 0.5F * slope_north + flat_light) /
                        std::sqrt(1 + slope_east * slope_east + slope_north * slope_north);
  return std::clamp(towards, 0.0F, 1.0F);
}

/// What such light makes of a colour: each channel times `factor` plus `white`, relative to flat ground,
/// which keeps its colour. Bright slopes go towards white instead of saturating one channel after another,
/// which would change the hue.
struct Lighting {
  float factor;
  float white;
};
inline Lighting lighting(float reflected) {
  constexpr float darkest = 0.2F;
  constexpr float whitest = 0.6F;
  const float relative = reflected / flat_light;
  const float brightened = whitest * (relative - 1);
  return relative <= 1 ? Lighting{darkest + (1 - darkest) * relative, 0}
                       : Lighting{1 - brightened, 255 * brightened};
}

/// Light reflected by each cell in [0, 1] under a lamp in the north-west, 45 degrees high; heights are
/// exaggerated first. Unknown cells and those beside them count as flat.
std::vector<float> hill_shade(const GridGeometry& geometry, const HeightMap::Layer& elevation,
                              double exaggeration = 1);

/// The colour of each cell: the palette's, darkened by hill shading of `relief` (the layer itself when null).
std::vector<Rgb> shaded_colours(const GridGeometry& geometry, const HeightMap::Layer& values, Palette palette,
                                ValueRange range, const HeightMap::Layer* relief = nullptr,
                                double exaggeration = 1);

}  // namespace aeolian
