#pragma once

#include <map>
#include <utility>
#include <vector>

#include "aeolian_core/measure/ripple_tracking.hpp"

namespace aeolian {

/// Puts together what the rows say of where crest lines go.
class CrestMotions {
 public:
  /// Fills in the motions of these maps, whose rows lie along a direction [rad].
  CrestMotions(std::vector<TrackedMap>& maps, double direction);

  /// The tracks of one row; the row as seen on each map, null where it is not.
  void add(const std::vector<CrestTrack>& tracks, const std::vector<const TrackRow*>& row);
  /// Sets ids, speeds and celerities.
  void finish();

 private:
  /// Numbers of a crest on two maps and how many of their rows are of one track.
  using Shared = std::map<std::pair<int, int>, int>;
  std::vector<int> best_of(const Shared& shared, std::size_t count, bool later) const;

  std::vector<TrackedMap>& maps_;
  double direction_;
  int next_id_ = 0;
  std::vector<Shared> shared_;                                  ///< with the map before
  std::vector<std::vector<std::vector<double>>> displacement_;  ///< of each map's crests, row by row [m]
};

}  // namespace aeolian
