#include "aeolian_core/surface/shading.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr Rgb unknown_colour{160, 160, 160};

// Evenly spaced colours of rising lightness, so that the palettes also read in grey and for the colour-blind.
constexpr std::array<Rgb, 6> sand{
    {{54, 33, 20}, {104, 66, 36}, {158, 106, 56}, {204, 154, 92}, {233, 200, 148}, {250, 238, 212}}};
constexpr std::array<Rgb, 7> diverging{{{23, 64, 125},
                                        {67, 129, 185},
                                        {155, 196, 222},
                                        {247, 247, 247},
                                        {240, 170, 135},
                                        {209, 88, 75},
                                        {128, 15, 36}}};
constexpr std::array<Rgb, 6> viridis{
    {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
constexpr Rgb grey{205, 205, 205};

template <std::size_t Count>
Rgb interpolated(const std::array<Rgb, Count>& stops, double value) {
  const double position = value * static_cast<double>(Count - 1);
  const std::size_t below = std::min(static_cast<std::size_t>(position), Count - 2);
  const double share = position - static_cast<double>(below);
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c)
    result[c] =
        static_cast<std::uint8_t>(std::lround((1 - share) * stops[below][c] + share * stops[below + 1][c]));
  return result;
}

}  // namespace

Rgb colour(Palette palette, double value) {
  if (std::isnan(value)) return unknown_colour;
  const double clamped = std::clamp(value, 0.0, 1.0);
  switch (palette) {
    case Palette::sand:
      return interpolated(sand, clamped);
    case Palette::diverging:
      return interpolated(diverging, clamped);
    case Palette::viridis:
      return interpolated(viridis, clamped);
    case Palette::grey:
      break;
  }
  return grey;
}

ValueRange display_range(const HeightMap::Layer& values, Palette palette) {
  HeightMap::Layer known;
  known.reserve(values.size());
  std::copy_if(values.begin(), values.end(), std::back_inserter(known),
               [](float v) { return std::isfinite(v); });
  if (known.empty()) return {};
  const auto percentile = [&](double share) {
    const auto rank = std::lround(share * static_cast<double>(known.size() - 1));
    std::nth_element(known.begin(), known.begin() + rank, known.end());
    return static_cast<double>(known[static_cast<std::size_t>(rank)]);
  };
  const ValueRange range{percentile(0.02), percentile(0.98)};
  if (palette != Palette::diverging) return range;
  double bound = std::max(std::abs(range.low), std::abs(range.high));
  if (bound == 0)
    for (const float v : known) bound = std::max(bound, std::abs(static_cast<double>(v)));
  return {0 - bound, bound};
}

std::vector<float> hill_shade(const GridGeometry& geometry, const HeightMap::Layer& elevation,
                              double exaggeration) {
  const int nx = geometry.nx();
  const int ny = geometry.ny();
  std::vector<float> shade(geometry.size(), flat_light);
  for (int y = 0; y < ny; ++y) {
    const int south = std::max(y - 1, 0);
    const int north = std::min(y + 1, ny - 1);
    for (int x = 0; x < nx; ++x) {
      const int west = std::max(x - 1, 0);
      const int east = std::min(x + 1, nx - 1);
      const auto slope = [&](CellIndex from, CellIndex to, int cells) {
        const float rise = elevation[geometry.index(to)] - elevation[geometry.index(from)];
        return cells > 0 ? rise * static_cast<float>(exaggeration / (cells * geometry.cell())) : 0.0F;
      };
      const float dx = slope({west, y}, {east, y}, east - west);
      const float dy = slope({x, south}, {x, north}, north - south);
      if (!std::isfinite(dx + dy + elevation[geometry.index(x, y)])) continue;
      shade[geometry.index(x, y)] = reflected_light(dx, dy);
    }
  }
  return shade;
}

std::vector<Rgb> shaded_colours(const GridGeometry& geometry, const HeightMap::Layer& values, Palette palette,
                                ValueRange range, const HeightMap::Layer* relief, double exaggeration) {
  const std::vector<float> shade = hill_shade(geometry, relief ? *relief : values, exaggeration);
  const double width = range.high - range.low;
  std::vector<Rgb> result(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = static_cast<double>(values[i]);
    const double share = width > 0 ? (value - range.low) / width : value * 0 + 0.5;
    result[i] = colour(palette, share);
    if (!std::isfinite(values[i])) continue;
    const Lighting light = lighting(shade[i]);
    for (std::uint8_t& channel : result[i])
      channel = static_cast<std::uint8_t>(static_cast<float>(channel) * light.factor + light.white);
  }
  return result;
}

}  // namespace aeolian
