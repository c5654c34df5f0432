#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/measure/fusion_tile.hpp"
#include "aeolian_core/measure/height_change.hpp"
#include "aeolian_core/measure/sensor_noise.hpp"
#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

namespace layer {
inline const std::string rate = "rate";                    ///< of the elevation [m/s]
inline const std::string rate_variance = "rate_variance";  ///< of the rate [m^2/s^2]
}  // namespace layer

struct FusionParameters {
  SensorNoise sensor;
  HeightChange change;
  /// Drop points that do not lie on the bed: grains in flight, flying pixels, plants. Otherwise each point
  /// counts.
  bool robust = true;
  /// A point farther from its cell's predicted height than so many standard deviations (its own and the
  /// prediction's), plus what a bed at the angle of repose spans within a cell, does not agree with it ...
  double gate_sigma = 4;
  /// ... unless so many scans in a row disagree in the same way: with the next the cell begins anew.
  int gate_patience = 2;

  /// Throws Error naming a parameter that is not positive where it must be.
  void require_valid() const;
};

/// What one cloud did to the map.
struct FusionResult {
  TileMask changed;      ///< tiles in which a cell got a new value
  std::size_t used = 0;  ///< points that fell into the map
  std::size_t not_finite = 0;
  std::size_t out_of_range = 0;   ///< nearer or farther than the sensor can see or absurdly high
  std::size_t outside = 0;        ///< beside the map
  std::size_t outlier_cells = 0;  ///< cells whose points were refused by the gate
  std::size_t outliers = 0;       ///< points of these cells that were refused
};

/// The live height map. Each cell tracks height and rate of change of the bed (HeightChange) and, as long as
/// its tile of 32 x 32 cells is still, averages on without end; points are weighed by SensorNoise. One pass
/// over the points, no separate step. A still tile takes quick scans together (those within 1/64 of
/// rate_time) and tells of them once, with the first.
///
/// Clouds of one stamp are one scan: the map is the same, to the bit, however the scan is cut into clouds, in
/// which order its points come and how many threads (oneTBB's) work on it. A cloud that is late by less than
/// ten seconds joins the map at the time that each cell has reached.
///
/// A cloud whose origin lies beyond the sensor's max_range is georeferenced: its points have been seen from
/// many places, so the range limits do not apply to it and its heights have the standard deviation
/// range_sigma.
///
/// Layers: elevation [m], variance [m^2], rate [m/s], rate_variance [m^2/s^2]. Heights from -16383 to 16383
/// m, in steps of 7.6 um (fixed_point.hpp).
///
///     HeightFusion fusion(geometry, parameters);
///     FusionResult r = fusion.add(cloud, sensor_to_map, stamp_s);
///     const HeightMap& map = fusion.map();
class HeightFusion {
 public:
  /// Throws Error unless the parameters are valid.
  HeightFusion(const GridGeometry& geometry, const FusionParameters& parameters);
  /// Continues a known map (elevation, optional variance, rate and rate_variance); `stamp` [s] is the time it
  /// holds for. A known cell without variance is taken to be as good as one point of the sensor; a height
  /// that cannot be (not finite, out of the range below) is unknown.
  HeightFusion(const HeightMap& map, const FusionParameters& parameters, double stamp);
  ~HeightFusion();
  HeightFusion(HeightFusion&&) noexcept;
  HeightFusion& operator=(HeightFusion&&) noexcept;

  /// Adds a cloud in sensor coordinates; `pose` takes them to the map frame; `stamp` in seconds on any clock.
  /// A stamp more than ten seconds before the last one (a bag that loops) restarts the clock and keeps the
  /// map. Throws Error for a stamp or pose that is not finite and for coordinates of different counts.
  FusionResult add(const PointCloud& cloud, const Eigen::Isometry3d& pose, double stamp);
  /// The same for a cloud of another sensor than the parameters name.
  FusionResult add(const PointCloud& cloud, const Eigen::Isometry3d& pose, double stamp,
                   const SensorNoise& sensor);

  /// Replaces the cells of the map where `mask` is not NaN by those of `known`, a map of the same grid with
  /// the layers that the constructor takes; a cell without elevation there is forgotten. They hold from now
  /// on. Returns the tiles that have such cells. Throws Error for another grid.
  TileMask replace(const HeightMap& known, const HeightMap::Layer& mask);

  /// The map as it is: what clouds have changed is written when it is asked for, the layers of all tiles or
  /// of some, the others being as they were. References stay valid; only one thread at a time may ask.
  const HeightMap& map() const;
  const HeightMap& map(const TileMask& tiles) const;
  /// How many points each cell rests on; unknown for unknown cells.
  HeightMap::Layer counts() const;
  void clear();

 private:
  struct Workers;

  void set_clock(double stamp);
  void work_on_tiles(std::size_t points, FusionResult& result);
  TileLayers layers_of_tile(std::size_t tile, const TileMask& tiling) const;

  mutable HeightMap map_;
  mutable bool is_written_ = true;  ///< the map is as the tiles say
  mutable bool is_read_ = false;    ///< since the last cloud: its reader will most likely read on
  FusionParameters parameters_;
  FusionRules rules_;
  std::vector<std::unique_ptr<FusionTile>> tiles_;
  std::unique_ptr<Workers> workers_;
  double epoch_ = 0;          ///< stamp of time zero of the cells [s]
  double last_stamp_ = 0;     ///< [s]
  std::uint32_t newest_ = 0;  ///< time of the newest scan [ms]
  std::uint32_t scan_ = 0;    ///< 0: none yet
};

}  // namespace aeolian
