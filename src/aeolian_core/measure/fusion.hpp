#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// The noise of a range sensor: standard deviation along the ray = range_sigma + range_sigma_per_metre *
/// range [m].
///
/// A range error d moves a point along its ray, which misses the surface by d (cos b - sin b tan s): b is the
/// ray's angle to the vertical, s the slope of the bed along the ray. The variance of a height is therefore
/// taken as sigma^2 (cos^2 b + m^2 sin^2 b) with an rms slope of the bed m = 0.1. Pointing errors are assumed
/// to be small beside it.
struct SensorNoise {
  double range_sigma = 0.001;          ///< [m]
  double range_sigma_per_metre = 0.0;  ///< [m/m]
};

struct FusionParameters {
  SensorNoise sensor;
  /// Random walk of the true surface between clouds [m/sqrt(s)]; too little lags behind migrating ripples.
  double change_rate = 2e-4;
  /// A cell's mean farther than so many standard deviations off is an outlier ...
  double gate_sigma = 5;
  /// ... unless it is so for more than this many clouds in a row: then the cell restarts.
  int gate_patience = 2;
  double min_range = 0.0;  ///< points nearer to the sensor are ignored [m]
  double max_range = 1e4;  ///< points farther away are ignored [m]
};

/// What one cloud did to the map.
struct FusionResult {
  TileMask changed;      ///< tiles in which a cell got a new value
  std::size_t used = 0;  ///< points that fell into the map
  std::size_t not_finite = 0;
  std::size_t out_of_range = 0;   ///< nearer than min_range or farther than max_range
  std::size_t outside = 0;        ///< beside the map
  std::size_t outlier_cells = 0;  ///< cells whose new mean was refused by the gate
};

/// The live height map: per cell a Kalman filter of the height under a random walk, updated once for each
/// cloud with the inverse-variance mean of the cloud's points in the cell.
///
/// A cloud whose origin lies beyond max_range is georeferenced: its points have been seen from many places,
/// so the range limits do not apply to it and its heights have the standard deviation range_sigma.
///
/// Layers: elevation [m], variance [m^2]. The result does not depend on the order of the points beyond
/// rounding and not at all on threads.
///
///     HeightFusion fusion(geometry, parameters);
///     FusionResult r = fusion.add(cloud, sensor_to_map, stamp_s);
///     const HeightMap& map = fusion.map();
class HeightFusion {
 public:
  /// Throws Error naming a parameter that is not positive where it must be.
  HeightFusion(const GridGeometry& geometry, const FusionParameters& parameters);
  /// Continues a known map (elevation, optional variance); `stamp` [s] is the time it holds for. A known cell
  /// without variance is taken to be as good as one point of the sensor.
  HeightFusion(const HeightMap& map, const FusionParameters& parameters, double stamp);

  /// Adds a cloud in sensor coordinates; `pose` takes them to the map frame; `stamp` in seconds on any clock.
  /// A stamp before the last one (a bag that loops) restarts the clock and keeps the map. Throws Error for a
  /// stamp or pose that is not finite and for coordinates of different counts.
  FusionResult add(const PointCloud& cloud, const Eigen::Isometry3d& pose, double stamp);

  const HeightMap& map() const { return map_; }
  void clear();

 private:
  void check_parameters() const;
  void set_clock(double stamp);
  void gather(const PointCloud& cloud, const Eigen::Isometry3d& pose, FusionResult& result);
  void update(double stamp, FusionResult& result);

  HeightMap map_;
  FusionParameters parameters_;
  std::vector<double> updated_;         ///< stamp of each cell's last update [s]
  std::vector<std::uint8_t> refusals_;  ///< clouds in a row that the gate refused
  struct Sums {
    double weight = 0;
    double weighted_height = 0;
  };
  std::vector<Sums> sums_;              ///< of the present cloud; zero between calls
  std::vector<std::uint32_t> touched_;  ///< cells with points of the present cloud
  double last_stamp_ = 0;
  bool has_stamp_ = false;
};

}  // namespace aeolian
