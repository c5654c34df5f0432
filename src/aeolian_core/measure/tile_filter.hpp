#pragma once

#include <cstddef>
#include <cstdint>

#include "aeolian_core/measure/fixed_point.hpp"
#include "aeolian_core/measure/height_change.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// The filters of a row of 32 cells, an array for each number: two Kalman filters a cell as predicted for the
/// row's time, and the sums of the open scan's points, from which the estimate follows. All of a row lies
/// together, so that rows without points cost no memory's time.
///
/// The first filter tracks height and rate under HeightChange. The second takes the bed to be still: its
/// variance falls as long as nothing moves. Which of them speaks, the tile decides.
struct alignas(64) FilterRow {
  static constexpr std::size_t cells = TileMask::tile_cells;

  std::int32_t height[cells] = {};    ///< tracked [steps]
  float rate[cells] = {};             ///< [m/s]
  float height_variance[cells] = {};  ///< [m^2]; 0: nothing is known of the cell
  float covariance[cells] = {};       ///< [m^2/s]
  float rate_variance[cells] = {};    ///< [m^2/s^2]
  float still_offset[cells] = {};     ///< height of the still filter minus tracked height [m]
  float still_variance[cells] = {};   ///< [m^2]
  std::uint32_t count[cells] = {};    ///< points on which a known cell rests
  double weight[cells] = {};          ///< of the scan's points
  double moment[cells] = {};          ///< of the scan's points: weight x (height - tracked) [steps]
};

/// How much the cells of a tile seem to move, in whole numbers.
struct TileMotion {
  static constexpr int unit = 256;
  std::int64_t cells = 0;  ///< with points, whose rate is known somewhat
  std::int64_t rate = 0;   ///< sum of rate^2 / variance [1/unit]
  std::int64_t drift = 0;  ///< sum of (still - tracked height)^2 / tracked variance [1/unit]

  void add(const TileMotion& other) {
    cells += other.cells;
    rate += other.rate;
    drift += other.drift;
  }
};

/// From the sums of points to what they say of a cell.
struct PointScale {
  PointScale() = default;
  /// `weight_scale`: weight times variance of a point [m^2].
  explicit PointScale(double weight_scale) : information(1 / weight_scale), pull(fixed::step * information) {}
  double information = 0;  ///< of a weight [1/m^2]
  double pull = 0;         ///< of a moment [1/m]
};

/// Takes the open scan's points into the filters, empties the sums and moves both filters on in time. A rate
/// variance below `known_rate_variance` counts as known.
TileMotion close_scan(FilterRow& row, bool still, const PointScale& scale, float known_rate_variance,
                      const HeightStep& step);

/// Moves both filters on in time; with `restart_still` the still one begins with what is tracked.
void predict(FilterRow& row, const HeightStep& step, bool restart_still);

/// What a cell says of the bed.
struct CellEstimate {
  double height = 0;         ///< [m]
  double variance = 0;       ///< [m^2]
  double rate = 0;           ///< [m/s]
  double rate_variance = 0;  ///< [m^2/s^2]
};

/// A row of cells in the layers of a map.
struct RowLayers {
  float* elevation;
  float* variance;
  float* rate;
  float* rate_variance;
};

/// Writes what the cells with points in the open scan say of the bed, these points included.
void write_estimates(const FilterRow& row, bool still, const PointScale& scale, const RowLayers& layers,
                     std::size_t columns);
/// The same of one cell, with or without points.
CellEstimate estimate(const FilterRow& row, std::size_t column, bool still, const PointScale& scale);

}  // namespace aeolian
