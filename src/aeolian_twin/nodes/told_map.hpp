#pragma once

#include <optional>

#include "aeolian_core/surface/tile_mask.hpp"
#include "aeolian_twin/nodes/live_map.hpp"

namespace aeolian {

/// The live map as its listeners are told of it: brought up to date where something has changed. Of a still
/// tile that takes scans together (HeightFusion) it shows the first, until the tile tells again.
class ToldMap {
 public:
  /// `live` must outlive this.
  explicit ToldMap(const LiveMap& live) : live_(live) {}

  /// Values of these tiles have changed, or, with note_all(), the map is another one.
  void note(const TileMask& changed) {
    if (untold_) untold_->merge(changed);
  }
  void note_all() { untold_.reset(); }
  /// The map as it is to be told now.
  const HeightMap& tell() {
    const HeightMap& map = untold_ ? live_.map(*untold_) : live_.map();
    untold_ = TileMask(map.geometry());
    return map;
  }

 private:
  const LiveMap& live_;
  std::optional<TileMask> untold_;  ///< changed since the last tell(); nothing: all
};

}  // namespace aeolian
