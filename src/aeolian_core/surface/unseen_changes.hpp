#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// What others have not seen of a map that a fusion keeps refining: keeps the elevation and variance that
/// each tile was last handed out with and hands a tile out again when it differs notably, that is when
///  - a cell became known or unknown,
///  - a cell moved by more than five standard deviations (of both heights),
///  - the mean of (z - z_seen)^2 / variance_seen over the tile's cells exceeds 1/4,
///  - the mean variance fell below half or rose above twice of what was seen.
/// So others have every tile to within half a standard deviation (rms) and know how sure it is. What is not
/// handed out is compared with the old copy again the next time: a slow drift is handed out when it has
/// become notable. A still scene whose noise averages out is handed out each time that it rests on a third
/// more points: with logarithmic frequency.
class UnseenChanges {
 public:
  /// Nothing has been seen yet.
  explicit UnseenChanges(const GridGeometry& geometry);

  /// Those of the touched tiles that differ notably; they count as seen from now on. Throws Error for a map
  /// or tiles of another grid and for a map without elevation or variance.
  TileMask take(const HeightMap& map, const TileMask& touched);

 private:
  struct Difference;
  /// The cells of a tile side by side, so that those of few tiles are few pieces of memory; NaN beyond the
  /// map.
  struct Tile {
    std::array<float, TileMask::tile_cells * TileMask::tile_cells> elevation, variance;
  };

  static void compare(const Tile& tile, const Tile& seen, Difference& difference);

  GridGeometry geometry_;
  std::vector<Tile> seen_;
};

}  // namespace aeolian
