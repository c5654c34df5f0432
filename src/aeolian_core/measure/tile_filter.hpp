#pragma once

#include <cstddef>
#include <cstdint>

#include "aeolian_core/measure/fixed_point.hpp"
#include "aeolian_core/measure/height_change.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// The filters of 32 x 32 cells, an array for each number: two Kalman filters a cell as predicted for the
/// open scan, and the sums of the scan's points, from which the estimate follows.
///
/// The first filter tracks height and rate under HeightChange. The second takes the bed to be still: its
/// variance falls as long as nothing moves. Which of them speaks, the tile decides.
struct TileFilter {
  static constexpr int side = TileMask::tile_cells;
  static constexpr std::size_t cells = std::size_t{side} * side;

  std::int32_t height[cells] = {};    ///< tracked [steps]
  float rate[cells] = {};             ///< [m/s]
  float height_variance[cells] = {};  ///< [m^2]; 0: nothing is known of the cell
  float covariance[cells] = {};       ///< [m^2/s]
  float rate_variance[cells] = {};    ///< [m^2/s^2]
  float still_offset[cells] = {};     ///< height of the still filter minus tracked height [m]
  float still_variance[cells] = {};   ///< [m^2]
  double weight[cells] = {};          ///< of the scan's points
  double moment[cells] = {};          ///< of the scan's points: weight x (height - tracked) [steps]
};

/// How much the cells of a tile seem to move, in whole numbers.
struct TileMotion {
  static constexpr int unit = 256;
  std::int64_t cells = 0;  ///< with points, whose rate is known somewhat
  std::int64_t rate = 0;   ///< sum of rate^2 / variance [1/unit]
  std::int64_t drift = 0;  ///< sum of (still - tracked height)^2 / tracked variance [1/unit]
};

/// Takes the open scan's points into the filters and empties the sums. A rate variance below
/// `known_rate_variance` counts as known. `weight_scale`: weight times variance of a point [m^2].
TileMotion close_scan(TileFilter& filter, bool still, float weight_scale, float known_rate_variance);

/// Moves both filters on in time.
void predict(TileFilter& filter, const HeightStep& step);

/// What the cells say of the bed, the open scan's points included.
struct TileEstimate {
  float information[TileFilter::cells];    ///< of the open scan's points; 0: the cell has none [1/m^2]
  float height[TileFilter::cells];         ///< [m]
  float variance[TileFilter::cells];       ///< [m^2]
  float rate[TileFilter::cells];           ///< [m/s]
  float rate_variance[TileFilter::cells];  ///< [m^2/s^2]
};
void estimate(const TileFilter& __restrict filter, bool still, float weight_scale,
              TileEstimate& __restrict result);

/// A layer of the map from a tile's first cell on: as many rows and columns as lie in the map, rows `stride`
/// apart.
struct TileWindow {
  std::size_t rows, columns, stride;
};

/// Copies one of the estimate's arrays into a layer, for the cells with points in the open scan.
void write_touched(const TileEstimate& __restrict estimate, const float* __restrict values,
                   float* __restrict layer, const TileWindow& window);

}  // namespace aeolian
