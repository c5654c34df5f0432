#pragma once

#include <array>
#include <limits>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/shading.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// What is drawn of a map; the map must outlive it.
struct DrawnLayers {
  const GridGeometry& geometry;
  const HeightMap::Layer& heights;
  const HeightMap::Layer& values;  ///< shown as colour
};

/// How it is drawn.
struct SurfaceLook {
  Palette palette = Palette::sand;
  ValueRange range;                       ///< values of the first and last colour
  bool shaded = true;                     ///< slopes are darker or brighter
  double exaggeration = 1;                ///< of the heights above the lowest
  std::array<double, 3> offset{0, 0, 0};  ///< added to every point [m]

  friend bool operator==(const SurfaceLook& a, const SurfaceLook& b) {
    return a.palette == b.palette && a.range.low == b.range.low && a.range.high == b.range.high &&
           a.shaded == b.shaded && a.exaggeration == b.exaggeration && a.offset == b.offset;
  }
};

/// The colours of a map's cells and its lowest height, kept up to date tile by tile: at every moment what
/// they would be if they were made anew.
class DrawnCells {
 public:
  /// Gives the cells whose place or colour may differ from before: those of the changed tiles and, as shading
  /// looks at the neighbours, those beside them; all for another grid or look or a new lowest height.
  std::vector<CellRange> update(const DrawnLayers& layers, const SurfaceLook& look, const TileMask& changed);

  const GridGeometry& geometry() const { return geometry_; }
  const SurfaceLook& look() const { return look_; }
  const Rgb& colour(std::size_t cell) const { return colours_[cell]; }
  /// [m]; zero when no cell is known.
  double lowest() const { return lowest_; }
  /// A height above the lowest as it is drawn [m].
  double drawn_height(float height) const {
    return (static_cast<double>(height) - lowest_) * look_.exaggeration;
  }

 private:
  void colour(const DrawnLayers& layers, const CellRange& range);
  void find_lowest(const HeightMap::Layer& heights, const TileMask& changed);

  GridGeometry geometry_;
  SurfaceLook look_;
  std::vector<Rgb> colours_;
  std::vector<float> lowest_of_tiles_;
  double lowest_ = std::numeric_limits<double>::quiet_NaN();  ///< nothing is drawn yet
};

/// Zero when no cell is known.
double lowest_height(const HeightMap::Layer& heights);

/// A range with one more cell on each side, as far as the grid goes.
CellRange grown(const CellRange& range, const GridGeometry& geometry);

}  // namespace aeolian
