#include "aeolian_rviz/height_map_colours.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr int table_size = 1024;
constexpr float flat_light = 0.70710678F;

/// Rise per cell: central where both neighbours are known, else towards the one that is.
float rise(float before, float here, float after) {
  if (std::isfinite(after - before)) return 0.5F * (after - before);
  if (std::isfinite(after - here)) return after - here;
  if (std::isfinite(here - before)) return here - before;
  return 0;
}

/// How dark a contour is in a cell, 0 to 1, from the distance of the cell's centre to the line in cells.
float ink(float height, float rise_per_cell, float interval) {
  constexpr float half_width = 0.55F;
  const float spacing = interval / rise_per_cell;  // of the lines [cells]
  if (!(spacing < 1e6F)) return 0;
  const float level = std::round(height / interval);
  const float distance = std::abs(height / interval - level) * spacing;
  const float covered = std::clamp(0.5F + half_width - distance, 0.0F, 1.0F);
  // Lines closer than a few cells would be one dark area.
  const float apart = std::clamp((spacing - 2) / 3, 0.0F, 1.0F);
  const bool index_line = std::fmod(level, 5.0F) == 0;
  return covered * apart * (index_line ? 0.75F : 0.45F);
}

Rgb darkened(const Rgb& colour, float by) {
  Rgb result{};
  for (std::size_t c = 0; c < 3; ++c)
    result[c] = static_cast<std::uint8_t>(static_cast<float>(colour[c]) * (1 - by));
  return result;
}

Rgba with_alpha(const Rgb& c, std::uint8_t alpha) { return {c[0], c[1], c[2], alpha}; }

}  // namespace

HeightMapColours::HeightMapColours(const Colouring& colouring) : colouring_(colouring) {
  table_.reserve(table_size);
  for (int i = 0; i < table_size; ++i)
    table_.push_back(aeolian::colour(colouring.palette, i / (table_size - 1.0)));
}

Rgb HeightMapColours::plain(float value) const {
  if (!std::isfinite(value)) return aeolian::colour(colouring_.palette, std::nan(""));
  const double width = colouring_.range.high - colouring_.range.low;
  const double share =
      width > 0 ? std::clamp((static_cast<double>(value) - colouring_.range.low) / width, 0.0, 1.0) : 0.5;
  return table_[static_cast<std::size_t>(share * (table_size - 1) + 0.5)];
}

void HeightMapColours::colour(const GridGeometry& geometry, const HeightMap::Layer& heights,
                              const HeightMap::Layer& values, const CellRange& range, Rgba* out,
                              int pitch) const {
  const auto slope_per_rise = static_cast<float>(colouring_.exaggeration / geometry.cell());
  const auto interval = static_cast<float>(colouring_.contour_interval);
  for (int y = range.y0; y < range.y1; ++y) {
    const std::size_t row = geometry.index(0, y);
    const std::size_t south = geometry.index(0, std::max(y - 1, 0));
    const std::size_t north = geometry.index(0, std::min(y + 1, geometry.ny() - 1));
    Rgba* texel = out + static_cast<std::ptrdiff_t>(y - range.y0) * pitch;
    for (int x = range.x0; x < range.x1; ++x, ++texel) {
      const auto here = static_cast<std::size_t>(x);
      const auto west = static_cast<std::size_t>(std::max(x - 1, 0));
      const auto east = static_cast<std::size_t>(std::min(x + 1, geometry.nx() - 1));
      const float height = heights[row + here];
      if (!std::isfinite(height)) {
        std::size_t neighbour = row + here;
        for (const std::size_t i : {row + west, row + east, south + here, north + here})
          if (std::isfinite(heights[i])) neighbour = i;
        *texel = with_alpha(plain(values[neighbour]), 0);
        continue;
      }
      Rgb colour = plain(values[row + here]);
      if (colouring_.shaded || interval > 0) {
        // At the map's edge a neighbour is the cell itself, and the rise to the other counts half.
        const float edge_x = west == here || east == here ? 2.0F : 1.0F;
        const float edge_y = south == row || north == row ? 2.0F : 1.0F;
        const float dx = edge_x * rise(heights[row + west], height, heights[row + east]);
        const float dy = edge_y * rise(heights[south + here], height, heights[north + here]);
        if (colouring_.shaded) colour = lit(colour, reflected_light(dx * slope_per_rise, dy * slope_per_rise));
        if (interval > 0) {
          const float dark = ink(height, std::sqrt(dx * dx + dy * dy), interval);
          if (dark > 0) colour = darkened(colour, dark);
        }
      }
      *texel = with_alpha(colour, 255);
    }
  }
}

void halve(const Rgba* fine, int size, const CellRange& range, Rgba* coarse) {
  const int half = size / 2;
  for (int y = range.y0 / 2; y < (range.y1 + 1) / 2; ++y)
    for (int x = range.x0 / 2; x < (range.x1 + 1) / 2; ++x) {
      const Rgba* four = fine + static_cast<std::ptrdiff_t>(2 * y) * size + 2 * x;
      const std::array<Rgba, 4> texels{four[0], four[1], four[size], four[size + 1]};
      std::array<int, 3> sums{};
      int count = 0;
      for (const Rgba& texel : texels) {
        if (texel[3] == 0) continue;
        for (std::size_t c = 0; c < 3; ++c) sums[c] += texel[c];
        ++count;
      }
      Rgba& mean = coarse[static_cast<std::ptrdiff_t>(y) * half + x];
      mean = with_alpha(Rgb{texels[0][0], texels[0][1], texels[0][2]}, 0);
      if (count == 0) continue;
      for (std::size_t c = 0; c < 3; ++c) mean[c] = static_cast<std::uint8_t>(sums[c] / count);
      mean[3] = 255;
    }
}

ValueRange quick_display_range(const HeightMap::Layer& values, Palette palette) {
  constexpr std::size_t enough = 20000;
  constexpr std::size_t too_few = 1000;
  if (values.size() <= enough) return display_range(values, palette);
  HeightMap::Layer sample;
  // Odd, so that the cells do not all lie in a few columns of a grid whose width is round.
  const std::size_t step = values.size() / enough | 1U;
  for (std::size_t i = 0; i < values.size(); i += step)
    if (std::isfinite(values[i])) sample.push_back(values[i]);
  return display_range(sample.size() < too_few ? values : sample, palette);
}

ValueRange steady_range(const ValueRange& shown, const ValueRange& measured) {
  const double tolerance = 0.1 * (measured.high - measured.low);
  const bool fits = std::abs(shown.low - measured.low) <= tolerance &&
                    std::abs(shown.high - measured.high) <= tolerance;
  return fits ? shown : measured;
}

double round_contour_interval(const ValueRange& range) {
  const double width = range.high - range.low;
  if (!(width > 0)) return 0;
  const double least = width / 17;
  const double power = std::pow(10, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= least) return digit * power;
  return 10 * power;
}

}  // namespace aeolian
