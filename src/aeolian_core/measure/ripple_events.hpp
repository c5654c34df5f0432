#pragma once

#include <vector>

#include "aeolian_core/measure/ripple_tracking.hpp"

namespace aeolian {

/// A change in one row.
struct RowEvent {
  RippleChange kind = RippleChange::merger;
  int row = 0;
  int frame = 0;      ///< the map after it
  double time = 0;    ///< [s]
  double place = 0;   ///< along the row [m]
  double moving = 0;  ///< the same, less the way of the pattern since the first map [m]
  /// Of repulsions: map and number in its row of the crest upwind and of that downwind, before and after.
  struct Pair {
    std::size_t map = 0;
    int upwind = -1;
    int downwind = -1;
  };
  Pair before;
  Pair after;
};

/// The same change in neighbouring rows.
struct EventCluster {
  RippleChange kind = RippleChange::merger;
  std::vector<RowEvent> rows;  ///< by time
  double length = 0;           ///< along the crests [m]
};

/// Puts row events together that are of a kind (mergers with losses, splits with births; most rows decide),
/// no more than two rows, one map and half a wavelength apart, and drops what is shorter than half a
/// wavelength. Crests that go and come back at the place within three maps are left out, those that merge and
/// part are a repulsion. `wavelength` along the rows, by map [m].
std::vector<EventCluster> cluster_events(std::vector<RowEvent> events, const std::vector<double>& wavelength,
                                         double row_spacing);

/// Crests of a row that close to 0.65 wavelengths or less and are a quarter of a wavelength farther apart
/// before and after. `moved` is the way of the pattern up to each map.
std::vector<RowEvent> find_repulsions(const std::vector<CrestTrack>& tracks,
                                      const std::vector<CrestFrame>& frames, const std::vector<double>& moved,
                                      int row);

}  // namespace aeolian
