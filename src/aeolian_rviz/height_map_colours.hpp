#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// Red, green, blue, alpha, 0 to 255. Alpha is 0 where no height is known.
using Rgba = std::array<std::uint8_t, 4>;

/// How cells are coloured.
struct Colouring {
  Palette palette = Palette::sand;
  ValueRange range;  ///< of the first and last colour; both equal: the middle colour everywhere
  bool shaded = true;
  double exaggeration = 1;      ///< of the heights, for the shading
  double contour_interval = 0;  ///< of the true heights [m]; 0: no contours. Every fifth line is stronger.
  friend bool operator==(const Colouring& a, const Colouring& b) {
    return a.palette == b.palette && a.range.low == b.range.low && a.range.high == b.range.high &&
           a.shaded == b.shaded && a.exaggeration == b.exaggeration &&
           a.contour_interval == b.contour_interval;
  }
};

/// Colours parts of a map's cells.
class HeightMapColours {
 public:
  explicit HeightMapColours(const Colouring& colouring);

  /// Colours the cells of a range; `out` points to the colour of its first cell, rows are `pitch` apart.
  /// Cells with a height but no value are grey. Those without a height are transparent and take a neighbour's
  /// colour, so that no other bleeds into a rim when colours are interpolated.
  void colour(const GridGeometry& geometry, const HeightMap::Layer& heights, const HeightMap::Layer& values,
              const CellRange& range, Rgba* out, int pitch) const;

 private:
  /// The colour of a known neighbour of an unknown cell.
  Rgb beside(const GridGeometry& geometry, const HeightMap::Layer& heights, const HeightMap::Layer& values,
             int x, int y) const;

  Colouring colouring_;
  std::vector<Rgb> table_;  ///< the palette, finely, and the colour of the unknown
};

/// The texture of half the size: each colour is the mean of those of four that are not transparent,
/// transparent when all are. Both are square and rows lie close, `size` (even) is the finer one's. Only what
/// depends on a range of the finer one is written.
void halve(const Rgba* fine, int size, const CellRange& range, Rgba* coarse);

/// `display_range` of at most some 20 000 cells spread over the layer, in a time that does not grow with the
/// map.
ValueRange quick_display_range(const HeightMap::Layer& values, Palette palette);

/// `shown` while it still fits `measured` within a tenth of its width, otherwise `measured`: a range that
/// followed every small change would change all colours with each map.
ValueRange steady_range(const ValueRange& shown, const ValueRange& measured);

/// 1, 2 or 5 times a power of ten, so that 7 to 17 contours pass through the range; 0 for an empty range.
double round_contour_interval(const ValueRange& range);

}  // namespace aeolian
