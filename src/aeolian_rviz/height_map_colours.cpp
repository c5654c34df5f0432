#include "aeolian_rviz/height_map_colours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aeolian {
namespace {

constexpr int table_size = 1024;

bool finite(float value) { return std::abs(value) <= std::numeric_limits<float>::max(); }

/// Rise per cell: central where both neighbours are known, else towards the one that is.
float rise(float before, float here, float after) {
  const float central = 0.5F * (after - before);
  const float forward = after - here;
  const float backward = here - before;
  const float one_sided = finite(forward) ? forward : finite(backward) ? backward : 0.0F;
  return finite(central) ? central : one_sided;
}

/// How dark a contour is in a cell, 0 to 1, from the distance of the cell's centre to the line in cells.
float ink(float height, float rise_per_cell, float interval) {
  constexpr float half_width = 0.55F;
  const float spacing = std::min(interval / rise_per_cell, 1e6F);  // of the lines [cells]
  const float position = height / interval;
  const float level = std::floor(position + 0.5F);
  const float distance = std::abs(position - level) * spacing;
  const float covered = std::clamp(0.5F + half_width - distance, 0.0F, 1.0F);
  // Lines closer than a few cells would be one dark area, and on level ground there is none.
  const float apart = spacing < 1e6F ? std::clamp((spacing - 2) / 3, 0.0F, 1.0F) : 0.0F;
  const bool fifth = 5 * std::floor(level / 5 + 0.5F) == level;
  return covered * apart * (fifth ? 0.75F : 0.45F);
}

/// A row of a layer from one cell before a range to one after it, unknown beyond the map.
void take_row(const GridGeometry& geometry, const HeightMap::Layer& layer, const CellRange& range, int y,
              std::vector<float>& row) {
  std::fill(row.begin(), row.end(), HeightMap::unknown);
  if (y < 0 || y >= geometry.ny()) return;
  const int first = std::max(range.x0 - 1, 0);
  const int end = std::min(range.x1 + 1, geometry.nx());
  const auto from = layer.begin() + static_cast<std::ptrdiff_t>(geometry.index(first, y));
  std::copy(from, from + (end - first), row.begin() + (first - (range.x0 - 1)));
}

Rgba with_alpha(const Rgb& c, std::uint8_t alpha) { return {c[0], c[1], c[2], alpha}; }

/// What the cells of a row are multiplied and added with. Passes of their own over plain arrays, which the
/// compiler turns into vectors.
struct Row {
  explicit Row(std::size_t cells) : factor(cells, 1.0F), white(cells, 0.0F), place(cells) {}

  void shade(const std::vector<float>& south, const std::vector<float>& here, const std::vector<float>& north,
             float slope_per_rise) {
    for (std::size_t i = 0; i < factor.size(); ++i) {
      const float dx = slope_per_rise * rise(here[i], here[i + 1], here[i + 2]);
      const float dy = slope_per_rise * rise(south[i + 1], here[i + 1], north[i + 1]);
      const Lighting light = lighting(reflected_light(dx, dy));
      factor[i] = light.factor;
      white[i] = light.white;
    }
  }
  void draw_contours(const std::vector<float>& south, const std::vector<float>& here,
                     const std::vector<float>& north, float interval) {
    for (std::size_t i = 0; i < factor.size(); ++i) {
      const float dx = rise(here[i], here[i + 1], here[i + 2]);
      const float dy = rise(south[i + 1], here[i + 1], north[i + 1]);
      const float bare = 1 - ink(here[i + 1], std::sqrt(dx * dx + dy * dy), interval);
      factor[i] *= bare;
      white[i] *= bare;
    }
  }
  void find_places(const float* values, const ValueRange& range) {
    const auto low = static_cast<float>(range.low);
    const double width = range.high - range.low;
    const bool empty = !(width > std::numeric_limits<float>::min());
    const float scale = empty ? 0.0F : static_cast<float>((table_size - 1) / width);
    const float first = empty ? 0.5F * table_size : 0.5F;  // the half rounds
    for (std::size_t i = 0; i < place.size(); ++i)
      place[i] = finite(values[i]) ? static_cast<int>(std::clamp((values[i] - low) * scale + first, 0.0F,
                                                                 static_cast<float>(table_size - 1)))
                                   : table_size;
  }

  std::vector<float> factor;
  std::vector<float> white;
  std::vector<int> place;  ///< in the table; `table_size`: unknown
};

}  // namespace

HeightMapColours::HeightMapColours(const Colouring& colouring) : colouring_(colouring) {
  table_.reserve(table_size + 1);
  for (int i = 0; i < table_size; ++i)
    table_.push_back(aeolian::colour(colouring.palette, i / (table_size - 1.0)));
  table_.push_back(aeolian::colour(colouring.palette, std::nan("")));
}

void HeightMapColours::colour(const GridGeometry& geometry, const HeightMap::Layer& heights,
                              const HeightMap::Layer& values, const CellRange& range, Rgba* out,
                              int pitch) const {
  const auto cells = static_cast<std::size_t>(range.x1 - range.x0);
  const auto slope_per_rise = static_cast<float>(colouring_.exaggeration / geometry.cell());
  const auto interval = static_cast<float>(colouring_.contour_interval);
  Row row(cells);
  std::vector<float> south(cells + 2);
  std::vector<float> here(cells + 2);
  std::vector<float> north(cells + 2);
  take_row(geometry, heights, range, range.y0 - 1, south);
  take_row(geometry, heights, range, range.y0, here);
  for (int y = range.y0; y < range.y1; ++y) {
    take_row(geometry, heights, range, y + 1, north);
    row.find_places(&values[geometry.index(range.x0, y)], colouring_.range);
    std::fill(row.factor.begin(), row.factor.end(), 1.0F);
    std::fill(row.white.begin(), row.white.end(), 0.0F);
    if (colouring_.shaded) row.shade(south, here, north, slope_per_rise);
    if (interval > 0) row.draw_contours(south, here, north, interval);
    Rgba* texel = out + static_cast<std::ptrdiff_t>(y - range.y0) * pitch;
    for (std::size_t i = 0; i < cells; ++i, ++texel) {
      const Rgb& plain = table_[static_cast<std::size_t>(row.place[i])];
      for (std::size_t c = 0; c < 3; ++c)
        (*texel)[c] = static_cast<std::uint8_t>(static_cast<float>(plain[c]) * row.factor[i] + row.white[i]);
      (*texel)[3] = 255;
      if (finite(here[i + 1])) continue;
      const int x = range.x0 + static_cast<int>(i);
      *texel = with_alpha(beside(geometry, heights, values, x, y), 0);
    }
    std::swap(south, here);
    std::swap(here, north);
  }
}

Rgb HeightMapColours::beside(const GridGeometry& geometry, const HeightMap::Layer& heights,
                             const HeightMap::Layer& values, int x, int y) const {
  for (const CellIndex cell : {CellIndex{x - 1, y}, {x + 1, y}, {x, y - 1}, {x, y + 1}})
    if (geometry.contains(cell) && finite(heights[geometry.index(cell)])) {
      Row row(1);
      row.find_places(&values[geometry.index(cell)], colouring_.range);
      return table_[static_cast<std::size_t>(row.place[0])];
    }
  return table_.back();
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
  const bool fits =
      std::abs(shown.low - measured.low) <= tolerance && std::abs(shown.high - measured.high) <= tolerance;
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
