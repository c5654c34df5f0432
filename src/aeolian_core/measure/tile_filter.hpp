#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "aeolian_core/measure/fixed_point.hpp"
#include "aeolian_core/measure/height_change.hpp"

namespace aeolian {

/// The filters of a cell as predicted for its time, and the sums of the points that it has got since, from
/// which the estimate follows: a line of the cache, so that only cells with points cost memory's time.
///
/// The first filter tracks height and rate under HeightChange. The second takes the bed to be still: its
/// variance falls as long as nothing moves. Which of them speaks, the tile decides.
struct alignas(64) FilterCell {
  std::int32_t height = 0;    ///< tracked [steps]
  float rate = 0;             ///< [m/s]
  float height_variance = 0;  ///< [m^2]; 0: nothing is known of the cell
  float covariance = 0;       ///< [m^2/s]
  float rate_variance = 0;    ///< [m^2/s^2]
  float still_offset = 0;     ///< height of the still filter minus tracked height [m]
  float still_variance = 0;   ///< [m^2]
  std::uint32_t count = 0;    ///< points on which a known cell rests
  double weight = 0;          ///< of the points
  double moment = 0;          ///< of the points: weight x (height - tracked) [steps]
  std::uint32_t time = 0;     ///< of the prediction [ms]
};

/// From the sums of points to what they say of a cell.
struct PointScale {
  PointScale() = default;
  /// `weight_scale`: weight times variance of a point [m^2].
  explicit PointScale(double weight_scale) : information(1 / weight_scale), pull(fixed::step * information) {}
  double information = 0;  ///< of a weight [1/m^2]
  double pull = 0;         ///< of a moment [1/m]
};

/// Some cells that are worked on together.
struct CellBatch {
  static constexpr std::size_t size = 16;
  std::array<FilterCell*, size> cells;
  std::size_t count = 0;
};

/// How a batch of cells goes on.
struct CellSteps {
  std::array<FilterStep, CellBatch::size> steps;
  /// 1, or 0 where the still filter begins with what is tracked.
  std::array<float, CellBatch::size> still_share;
};

/// What points say of whether the bed is still: natural logarithms of likelihood ratios, in whole numbers.
struct MotionEvidence {
  static constexpr double unit = 1 << 16;  ///< of a ratio of e
  std::int64_t rest =
      0;  ///< they are where the still filter expects them, rather than where the tracking one does
  std::int64_t drift = 0;  ///< they are off the still filter the way in which the tracking one has gone

  void add(const MotionEvidence& other) {
    rest += other.rest;
    drift += other.drift;
  }
};

/// Takes the points of some cells into their filters, empties the sums and moves both filters on by the
/// steps. Returns what the points say, but for cells whose still filter begins anew. Steps past the batch are
/// filled up.
MotionEvidence advance(const CellBatch& batch, CellSteps& steps, const PointScale& scale);

/// What a cell says of the bed.
struct CellEstimate {
  double height = 0;         ///< [m]
  double variance = 0;       ///< [m^2]
  double rate = 0;           ///< [m/s]
  double rate_variance = 0;  ///< [m^2/s^2]
};

/// What some cells say of the bed, NaN where nothing is known.
struct CellEstimates {
  std::array<float, CellBatch::size> height, variance, rate, rate_variance;
};

/// The same of some cells, their points included; where `still_share` is 1 the still filter speaks.
CellEstimates estimates(const CellBatch& batch, const std::array<float, CellBatch::size>& still_share,
                        const PointScale& scale);

}  // namespace aeolian
