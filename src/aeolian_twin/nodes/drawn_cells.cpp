#include "aeolian_twin/nodes/drawn_cells.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/surface/submap.hpp"

namespace aeolian {
namespace {

std::vector<Rgb> plain_colours(const HeightMap::Layer& values, const SurfaceLook& look) {
  const double width = look.range.high > look.range.low ? look.range.high - look.range.low : 1;
  std::vector<Rgb> colours;
  colours.reserve(values.size());
  for (const float v : values)
    colours.push_back(colour(look.palette, (static_cast<double>(v) - look.range.low) / width));
  return colours;
}

}  // namespace

double lowest_height(const HeightMap::Layer& heights) {
  float lowest = std::numeric_limits<float>::infinity();
  for (const float z : heights)
    if (std::isfinite(z)) lowest = std::min(lowest, z);
  return std::isfinite(lowest) ? static_cast<double>(lowest) : 0;
}

CellRange grown(const CellRange& range, const GridGeometry& geometry) {
  return {std::max(range.x0 - 1, 0), std::min(range.x1 + 1, geometry.nx()), std::max(range.y0 - 1, 0),
          std::min(range.y1 + 1, geometry.ny())};
}

std::vector<CellRange> DrawnCells::update(const DrawnLayers& layers, const SurfaceLook& look,
                                          const TileMask& changed) {
  const bool anew = geometry_ != layers.geometry || !(look_ == look) || std::isnan(lowest_);
  const TileMask tiles = anew ? TileMask(layers.geometry, true) : changed;
  if (anew) {
    geometry_ = layers.geometry;
    look_ = look;
    colours_.resize(geometry_.size());
    lowest_of_tiles_.assign(
        static_cast<std::size_t>(tiles.tiles_x()) * static_cast<std::size_t>(tiles.tiles_y()),
        std::numeric_limits<float>::infinity());
  }
  std::vector<CellRange> ranges = rectangles(tiles);
  for (CellRange& range : ranges) {
    if (look_.shaded) range = grown(range, geometry_);
    colour(layers, range);
  }
  const double before = lowest_;
  find_lowest(layers.heights, tiles);
  if (lowest_ != before) ranges = {{0, geometry_.nx(), 0, geometry_.ny()}};
  return ranges;
}

void DrawnCells::colour(const DrawnLayers& layers, const CellRange& range) {
  const CellRange seen = look_.shaded ? grown(range, geometry_) : range;
  const GridGeometry part = part_of(geometry_, seen);
  const HeightMap::Layer values = part_of(geometry_, layers.values, seen);
  const HeightMap::Layer heights = part_of(geometry_, layers.heights, seen);
  const std::vector<Rgb> colours =
      look_.shaded ? shaded_colours(part, values, look_.palette, look_.range, &heights, look_.exaggeration)
                   : plain_colours(values, look_);
  for (int y = range.y0; y < range.y1; ++y) {
    const auto from =
        colours.begin() + static_cast<std::ptrdiff_t>(part.index(range.x0 - seen.x0, y - seen.y0));
    std::copy_n(from, range.x1 - range.x0,
                colours_.begin() + static_cast<std::ptrdiff_t>(geometry_.index(range.x0, y)));
  }
}

void DrawnCells::find_lowest(const HeightMap::Layer& heights, const TileMask& changed) {
  constexpr int side = TileMask::tile_cells;
  changed.for_each([&](const CellRange& tile) {
    float low = std::numeric_limits<float>::infinity();
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        if (const float z = heights[geometry_.index(x, y)]; std::isfinite(z)) low = std::min(low, z);
    const auto tx = static_cast<std::size_t>(tile.x0 / side);
    const auto ty = static_cast<std::size_t>(tile.y0 / side);
    lowest_of_tiles_[ty * static_cast<std::size_t>(changed.tiles_x()) + tx] = low;
  });
  const auto low = static_cast<double>(*std::min_element(lowest_of_tiles_.begin(), lowest_of_tiles_.end()));
  lowest_ = std::isfinite(low) ? low : 0;
}

}  // namespace aeolian
