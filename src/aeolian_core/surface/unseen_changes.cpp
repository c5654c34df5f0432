#include "aeolian_core/surface/unseen_changes.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr float farthest_squared = 25;      ///< of a cell [variances]
constexpr float notable_departure = 0.25F;  ///< mean square over a tile [variances]
constexpr float least_variance = 1e-12F;    ///< [m^2]: heights are not known to better than a micrometre

constexpr auto side = static_cast<std::size_t>(TileMask::tile_cells);
/// Columns of a tile that are worked on at once.
constexpr std::size_t lanes = 8;
using Floats = float __attribute__((vector_size(lanes * sizeof(float))));
using Ints = std::int32_t __attribute__((vector_size(lanes * sizeof(std::int32_t))));

template <class Number>
Number total(const std::array<Number, side>& columns) {
  return std::accumulate(columns.begin(), columns.end(), Number{});
}

AEOLIAN_INLINE void load(const float* from, Floats& to) { std::memcpy(&to, from, sizeof to); }

}  // namespace

/// How a tile differs from what was seen: a sum for each of its columns.
struct UnseenChanges::Difference {
  std::array<float, side> departure;  ///< (z - z_seen)^2 / variance_seen
  std::array<float, side> variance, seen_variance;
  std::array<std::int32_t, side> cells;   ///< known now and before
  std::array<std::int32_t, side> sudden;  ///< not 0: a cell became known or unknown or is too far off

  bool notable() const {
    if (total(sudden) != 0) return true;
    const float now = total(variance);
    const float before = total(seen_variance);
    return total(departure) > notable_departure * static_cast<float>(total(cells)) || now < before / 2 ||
           now > 2 * before;
  }
};

AEOLIAN_KERNEL void UnseenChanges::compare(const Tile& tile, const Tile& seen, Difference& difference) {
  const Floats least = Floats{} + least_variance;
  for (std::size_t x = 0; x < side; x += lanes) {
    Floats departure{}, variance{}, seen_variance{};
    Ints cells{}, sudden{};
    for (std::size_t at = x; at < side * side; at += side) {
      Floats z, seen_z, v, seen_v;
      load(&tile.elevation[at], z);
      load(&seen.elevation[at], seen_z);
      load(&tile.variance[at], v);
      load(&seen.variance[at], seen_v);
      const Floats now = v > least ? v : least;
      const Floats before = seen_v > least ? seen_v : least;
      const Floats step = z - seen_z;
      const Floats moved = step * step;
      const Ints both = step - step == 0.0F;
      departure += both ? moved / before : Floats{};
      variance += both ? now : Floats{};
      seen_variance += both ? before : Floats{};
      const Ints known = z - z == 0.0F;  // -1 where it is
      const Ints was_known = seen_z - seen_z == 0.0F;
      const Ints far = moved > farthest_squared * (now + before);
      cells -= known & was_known;
      sudden |= (known ^ was_known) | far;
    }
    std::memcpy(&difference.departure[x], &departure, sizeof departure);
    std::memcpy(&difference.variance[x], &variance, sizeof variance);
    std::memcpy(&difference.seen_variance[x], &seen_variance, sizeof seen_variance);
    std::memcpy(&difference.cells[x], &cells, sizeof cells);
    std::memcpy(&difference.sudden[x], &sudden, sizeof sudden);
  }
}

UnseenChanges::UnseenChanges(const GridGeometry& geometry) : geometry_(geometry) {
  const TileMask tiles(geometry);
  Tile unknown;
  unknown.elevation.fill(HeightMap::unknown);
  unknown.variance.fill(HeightMap::unknown);
  seen_.assign(static_cast<std::size_t>(tiles.tiles_x()) * static_cast<std::size_t>(tiles.tiles_y()),
               unknown);
}

TileMask UnseenChanges::take(const HeightMap& map, const TileMask& touched) {
  if (map.geometry() != geometry_) throw Error("unseen changes: the map has another grid than before");
  TileMask result(geometry_);
  if (touched.tiles_x() != result.tiles_x() || touched.tiles_y() != result.tiles_y())
    throw Error("unseen changes: the touched tiles are those of another grid");
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  const HeightMap::Layer& variance = map.layer(layer::variance);
  Tile tile;
  Difference difference;
  for (int ty = 0; ty < touched.tiles_y(); ++ty)
    for (int tx = 0; tx < touched.tiles_x(); ++tx) {
      if (!touched.tile(tx, ty)) continue;
      const CellRange range = touched.range(tx, ty);
      const auto width = static_cast<std::size_t>(range.x1 - range.x0);
      Tile& seen = seen_[static_cast<std::size_t>(ty * touched.tiles_x() + tx)];
      // A tile at the far edges is filled up with what was seen: it does not differ there.
      if (width < side || range.y1 - range.y0 < TileMask::tile_cells) tile = seen;
      for (int y = range.y0; y < range.y1; ++y) {
        const std::size_t from = geometry_.index(range.x0, y);
        const std::size_t to = static_cast<std::size_t>(y - range.y0) * side;
        std::copy_n(&elevation[from], width, &tile.elevation[to]);
        std::copy_n(&variance[from], width, &tile.variance[to]);
      }
      compare(tile, seen, difference);
      if (!difference.notable()) continue;
      result.set_tile(tx, ty);
      seen = tile;
    }
  return result;
}

}  // namespace aeolian
