#include "aeolian_core/surface/tile_mask.hpp"

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

TileMask::TileMask(const GridGeometry& geometry, bool active)
    : nx_(geometry.nx()),
      ny_(geometry.ny()),
      tiles_x_((geometry.nx() + tile_cells - 1) / tile_cells),
      tiles_y_((geometry.ny() + tile_cells - 1) / tile_cells),
      active_(static_cast<std::size_t>(tiles_x_) * static_cast<std::size_t>(tiles_y_), active ? 1 : 0) {}

void TileMask::merge(const TileMask& other) {
  if (other.nx_ != nx_ || other.ny_ != ny_) throw Error("tile mask: cannot merge masks of different grids");
  for (std::size_t i = 0; i < active_.size(); ++i) active_[i] = active_[i] | other.active_[i];
}

void TileMask::dilate() {
  const TileMask before = *this;
  for (int ty = 0; ty < tiles_y_; ++ty)
    for (int tx = 0; tx < tiles_x_; ++tx)
      if (before.tile(tx, ty))
        for (int y = std::max(0, ty - 1); y < std::min(tiles_y_, ty + 2); ++y)
          for (int x = std::max(0, tx - 1); x < std::min(tiles_x_, tx + 2); ++x) set_tile(x, y);
}

int TileMask::count() const {
  return static_cast<int>(std::count(active_.begin(), active_.end(), std::uint8_t{1}));
}

CellRange TileMask::range(int tx, int ty) const {
  return {tx * tile_cells, std::min(nx_, (tx + 1) * tile_cells), ty * tile_cells,
          std::min(ny_, (ty + 1) * tile_cells)};
}

std::vector<CellRange> rectangles(const TileMask& mask) {
  std::vector<CellRange> result;
  for (int ty = 0; ty < mask.tiles_y(); ++ty) {
    for (int tx = 0; tx < mask.tiles_x(); ++tx) {
      if (!mask.tile(tx, ty)) continue;
      CellRange run = mask.range(tx, ty);
      while (tx + 1 < mask.tiles_x() && mask.tile(tx + 1, ty)) run.x1 = mask.range(++tx, ty).x1;
      const auto below = std::find_if(result.begin(), result.end(), [&](const CellRange& r) {
        return r.y1 == run.y0 && r.x0 == run.x0 && r.x1 == run.x1;
      });
      if (below != result.end())
        below->y1 = run.y1;
      else
        result.push_back(run);
    }
  }
  return result;
}

}  // namespace aeolian
