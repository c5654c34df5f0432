#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "aeolian_core/surface/grid_geometry.hpp"

namespace aeolian {

/// Half-open rectangle of cells: x0 <= x < x1, y0 <= y < y1.
struct CellRange {
  int x0, x1, y0, y1;
  friend bool operator==(const CellRange& a, const CellRange& b) {
    return a.x0 == b.x0 && a.x1 == b.x1 && a.y0 == b.y0 && a.y1 == b.y1;
  }
};

/// Which tiles of 32 x 32 cells of a grid are active. Tiles at the far edges may be smaller.
///
/// Every algorithm that walks a map takes one and every producer of change returns one: the quiet parts of a
/// scene cost nothing.
class TileMask {
 public:
  static constexpr int tile_cells = 32;

  TileMask() = default;
  explicit TileMask(const GridGeometry& geometry, bool active = false);

  int tiles_x() const { return tiles_x_; }
  int tiles_y() const { return tiles_y_; }
  bool tile(int tx, int ty) const { return active_[at(tx, ty)] != 0; }
  void set_tile(int tx, int ty, bool active = true) { active_[at(tx, ty)] = active ? 1 : 0; }
  /// Makes the tile that holds a cell active.
  void activate(int ix, int iy) { active_[at(ix / tile_cells, iy / tile_cells)] = 1; }
  void clear() { std::fill(active_.begin(), active_.end(), std::uint8_t{0}); }
  /// Adds the active tiles of another mask of the same grid; throws Error for one of another size.
  void merge(const TileMask& other);
  /// Adds the neighbours, also diagonal, of every active tile.
  void dilate();
  int count() const;
  bool empty() const { return count() == 0; }
  CellRange range(int tx, int ty) const;

  /// Calls `visit(CellRange)` for each active tile, row by row.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (int ty = 0; ty < tiles_y_; ++ty)
      for (int tx = 0; tx < tiles_x_; ++tx)
        if (tile(tx, ty)) visit(range(tx, ty));
  }

 private:
  std::size_t at(int tx, int ty) const {
    return static_cast<std::size_t>(ty) * static_cast<std::size_t>(tiles_x_) + static_cast<std::size_t>(tx);
  }

  int nx_ = 0;
  int ny_ = 0;
  int tiles_x_ = 0;
  int tiles_y_ = 0;
  std::vector<std::uint8_t> active_;
};

/// Few rectangles that cover each cell of the active tiles once and no other: runs along x, joined over y
/// where they are alike. From south to north, from west to east.
std::vector<CellRange> rectangles(const TileMask& mask);

}  // namespace aeolian
