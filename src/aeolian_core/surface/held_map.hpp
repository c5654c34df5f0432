#pragma once

#include <chrono>
#include <optional>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/submap.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// The tiles of a map in which a value of a part of it differs, in a layer that both have; NaN equals NaN.
/// Throws Error when the range has not as many cells as the part or reaches beyond the whole.
TileMask differing_tiles(const HeightMap& part, const CellRange& at, const HeightMap& whole);

/// A map that arrives whole and in parts, kept up to date, and what each arrival changed of it.
///
/// Whole maps and parts come two ways, each in order but not against the other. So a whole map that is older
/// than the parts since, by less than ten seconds, is ignored; by more, time has jumped back (a bag that
/// loops) and it is taken. A part that fits no whole map waits until one has come that it fits and that is
/// not newer; only the last such part does.
class HeldMap {
 public:
  using Stamp = std::chrono::nanoseconds;

  /// Whether a whole map has come.
  bool known() const { return known_; }
  const HeightMap& map() const { return map_; }
  /// Of the newest data in the map.
  Stamp stamp() const { return stamp_; }

  /// Both give the tiles that hold a value that differs from before, all tiles when the grid or the layers
  /// are new; nothing when the map was left as it was because the arrival is too old or fits none.
  std::optional<TileMask> take_whole(HeightMap map, Stamp stamp);
  std::optional<TileMask> take_part(HeightMap part, Stamp stamp);

 private:
  struct Waiting {
    HeightMap part;
    Stamp stamp;
  };

  bool overtaken(const HeightMap& map, Stamp stamp) const;
  void paste_waiting();

  HeightMap map_;
  Stamp stamp_{};
  bool known_ = false;
  bool has_parts_ = false;  ///< since the last whole map
  std::optional<Waiting> waiting_;
};

}  // namespace aeolian
