#include "aeolian_core/surface/held_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Data that is older by more comes from the next turn of a bag that loops.
constexpr std::chrono::seconds jump_back{10};

bool differ(const float* a, const float* b, int count) {
  if (std::memcmp(a, b, static_cast<std::size_t>(count) * sizeof(float)) == 0) return false;
  return !std::equal(a, a + count, b,
                     [](float u, float v) { return u == v || (std::isnan(u) && std::isnan(v)); });
}

}  // namespace

TileMask differing_tiles(const HeightMap& part, const CellRange& at, const HeightMap& whole) {
  if (part_of(whole.geometry(), at).nx() != part.geometry().nx() || at.y1 - at.y0 != part.geometry().ny())
    throw Error("part of a map: " + std::to_string(part.geometry().nx()) + " x " +
                std::to_string(part.geometry().ny()) + " cells for " + std::to_string(at.x1 - at.x0) + " x " +
                std::to_string(at.y1 - at.y0));
  std::vector<std::pair<const float*, const float*>> layers;
  for (const std::string& name : part.names())
    if (whole.has(name)) layers.emplace_back(part.layer(name).data(), whole.layer(name).data());

  constexpr int side = TileMask::tile_cells;
  TileMask result(whole.geometry());
  for (int ty = at.y0 / side; ty * side < at.y1; ++ty) {
    for (int tx = at.x0 / side; tx * side < at.x1; ++tx) {
      const CellRange tile = result.range(tx, ty);
      const int x0 = std::max(tile.x0, at.x0);
      const int width = std::min(tile.x1, at.x1) - x0;
      const auto row_differs = [&](int y) {
        const std::size_t in_part = part.geometry().index(x0 - at.x0, y - at.y0);
        const std::size_t in_whole = whole.geometry().index(x0, y);
        return std::any_of(layers.begin(), layers.end(), [&](const auto& both) {
          return differ(both.first + in_part, both.second + in_whole, width);
        });
      };
      for (int y = std::max(tile.y0, at.y0); y < std::min(tile.y1, at.y1); ++y) {
        if (!row_differs(y)) continue;
        result.set_tile(tx, ty);
        break;
      }
    }
  }
  return result;
}

std::optional<TileMask> HeldMap::take_whole(HeightMap map, Stamp stamp) {
  if (overtaken(map, stamp)) return std::nullopt;
  const HeightMap before = std::exchange(map_, std::move(map));
  const bool alike = known_ && before.geometry() == map_.geometry() && before.names() == map_.names();
  known_ = true;
  has_parts_ = false;
  stamp_ = stamp;
  paste_waiting();
  if (!alike) return TileMask(map_.geometry(), true);
  return differing_tiles(before, {0, map_.geometry().nx(), 0, map_.geometry().ny()}, map_);
}

std::optional<TileMask> HeldMap::take_part(HeightMap part, Stamp stamp) {
  const auto at = known_ ? range_within(part.geometry(), map_.geometry()) : std::nullopt;
  if (!at) {
    // Before a whole map the whole may come as a part, and then parts of that.
    const auto in_waiting =
        waiting_ ? range_within(part.geometry(), waiting_->part.geometry()) : std::nullopt;
    if (in_waiting) {
      paste(part, *in_waiting, waiting_->part);
      waiting_->stamp = stamp;
    } else {
      waiting_ = Waiting{std::move(part), stamp};
    }
    return std::nullopt;
  }
  TileMask changed = differing_tiles(part, *at, map_);
  paste(part, *at, map_);
  has_parts_ = true;
  // A part may be late, when sensors have different latencies; the map is still that of the newest.
  if (stamp > stamp_ || stamp_ - stamp > jump_back) stamp_ = stamp;
  return changed;
}

bool HeldMap::overtaken(const HeightMap& map, Stamp stamp) const {
  return has_parts_ && stamp < stamp_ && stamp_ - stamp <= jump_back && map.geometry() == map_.geometry();
}

/// What waits for a whole map is pasted into the one that has come, or of no use any more.
void HeldMap::paste_waiting() {
  if (!waiting_) return;
  const auto at = range_within(waiting_->part.geometry(), map_.geometry());
  if (at && waiting_->stamp >= stamp_ && waiting_->stamp - stamp_ <= jump_back) {
    paste(waiting_->part, *at, map_);
    stamp_ = waiting_->stamp;
    has_parts_ = true;
  }
  waiting_.reset();
}

}  // namespace aeolian
