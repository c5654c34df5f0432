#include "aeolian_core/surface/unseen_changes.hpp"

#include <algorithm>
#include <array>
#include <numeric>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr float farthest_squared = 25;      ///< of a cell [variances]
constexpr float notable_departure = 0.25F;  ///< mean square over a tile [variances]
constexpr float least_variance = 1e-12F;    ///< [m^2]: heights are not known to better than a micrometre

template <class Number>
using Columns = std::array<Number, TileMask::tile_cells>;

/// How a tile differs from what was seen: a sum for each of its columns.
struct TileDifference {
  Columns<float> departure{};  ///< (z - z_seen)^2 / variance_seen
  Columns<float> variance{};
  Columns<float> seen_variance{};
  Columns<int> cells{};   ///< known now and before
  Columns<int> sudden{};  ///< not 0: a cell became known or unknown or is too far off

  bool notable() const {
    if (total(sudden) > 0) return true;
    const float now = total(variance);
    const float before = total(seen_variance);
    return total(departure) > notable_departure * static_cast<float>(total(cells)) || now < before / 2 ||
           now > 2 * before;
  }

  template <class Number>
  static Number total(const Columns<Number>& columns) {
    return std::accumulate(columns.begin(), columns.end(), Number{});
  }
};

/// One row of a tile as it is and as it was seen. Column by column, so that the loop becomes vectors without
/// changing the order of any sum.
void add_row(const float* __restrict z, const float* __restrict seen_z, const float* __restrict v,
             const float* __restrict seen_v, std::size_t width, TileDifference& __restrict difference) {
  for (std::size_t i = 0; i < width; ++i) {
    const float now = v[i] > least_variance ? v[i] : least_variance;
    const float before = seen_v[i] > least_variance ? seen_v[i] : least_variance;
    const float step = z[i] - seen_z[i];
    const float moved = step * step;
    const float share = moved / before;
    const bool both = step - step == 0.0F;
    difference.departure[i] += both ? share : 0.0F;
    difference.variance[i] += both ? now : 0.0F;
    difference.seen_variance[i] += both ? before : 0.0F;
    const int known = z[i] - z[i] == 0.0F ? 1 : 0;
    const int was_known = seen_z[i] - seen_z[i] == 0.0F ? 1 : 0;
    const int far = moved > farthest_squared * (now + before) ? 1 : 0;
    difference.cells[i] += known & was_known;
    difference.sudden[i] |= (known ^ was_known) | far;
  }
}

}  // namespace

UnseenChanges::UnseenChanges(const GridGeometry& geometry)
    : geometry_(geometry),
      elevation_(geometry.size(), HeightMap::unknown),
      variance_(geometry.size(), HeightMap::unknown) {}

TileMask UnseenChanges::take(const HeightMap& map, const TileMask& touched) {
  if (map.geometry() != geometry_) throw Error("unseen changes: the map has another grid than before");
  TileMask result(geometry_);
  if (touched.tiles_x() != result.tiles_x() || touched.tiles_y() != result.tiles_y())
    throw Error("unseen changes: the touched tiles are those of another grid");
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  const HeightMap::Layer& variance = map.layer(layer::variance);
  std::vector<TileDifference> differences(static_cast<std::size_t>(touched.tiles_x()));
  for (int ty = 0; ty < touched.tiles_y(); ++ty) {
    const auto for_each_row = [&](const TileMask& tiles, auto&& visit) {
      const CellRange rows = tiles.range(0, ty);
      for (int y = rows.y0; y < rows.y1; ++y)
        for (int tx = 0; tx < tiles.tiles_x(); ++tx) {
          if (!tiles.tile(tx, ty)) continue;
          const CellRange tile = tiles.range(tx, ty);
          visit(tx, geometry_.index(tile.x0, y), static_cast<std::size_t>(tile.x1 - tile.x0));
        }
    };
    // Along whole rows of the map, as they lie in memory.
    std::fill(differences.begin(), differences.end(), TileDifference());
    for_each_row(touched, [&](int tx, std::size_t at, std::size_t width) {
      add_row(&elevation[at], &elevation_[at], &variance[at], &variance_[at], width,
              differences[static_cast<std::size_t>(tx)]);
    });
    for (int tx = 0; tx < touched.tiles_x(); ++tx)
      if (differences[static_cast<std::size_t>(tx)].notable()) result.set_tile(tx, ty);
    for_each_row(result, [&](int, std::size_t at, std::size_t width) {
      std::copy_n(&elevation[at], width, &elevation_[at]);
      std::copy_n(&variance[at], width, &variance_[at]);
    });
  }
  return result;
}

}  // namespace aeolian
