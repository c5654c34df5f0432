#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/measure/ripple_statistics.hpp"

namespace aeolian {

/// What the program `grow_ripples` runs.
struct RippleRunSettings {
  Forcing forcing;
  double duration = 600;         ///< [s]
  double statistics_every = 10;  ///< [s]
  double map_every = 60;         ///< between maps that are kept [s]
};

/// The ripples at one time of a run.
struct RippleMoment {
  double time = 0;  ///< [s]
  RippleStatistics ripples;
  double speed = 0;  ///< of the pattern along the wind since the moment before [m/s]; NaN when not to be told
  double volume_error = 0;  ///< of the balance so far, relative to what moved
};

struct RippleRun {
  std::vector<RippleMoment> moments;
  VolumeBalance volume;
  double computing_time = 0;  ///< that the model took [s]
};

/// A level bed as a screed leaves it: each cell has the mean height of its grains, which lie up to half a
/// diameter higher or lower.
HeightMap screeded_bed(const GridGeometry& geometry, const Grain& grain, std::uint64_t seed);

/// Runs a model on a map; `keep(map, time)` is called at the beginning, every `map_every` and at the end,
/// `progress(share)` now and then. Throws Error for times that are not positive.
RippleRun run_ripples(HeightMap& map, BedModel& model, const RippleRunSettings& settings,
                      const std::function<void(const HeightMap&, double)>& keep,
                      const std::function<void(double)>& progress);

}  // namespace aeolian
