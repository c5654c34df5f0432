#include "aeolian_core/measure/tile_filter.hpp"

#include <cstddef>
#include <limits>

#include "aeolian_core/measure/transposition.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr std::size_t size = CellBatch::size;
constexpr auto step = static_cast<float>(fixed::step);
constexpr auto steps_per_metre = static_cast<float>(fixed::steps_per_metre);
/// Fixed-point heights stay within this far from the bound of 32 bits, whatever a rate says.
constexpr float longest_move = 1000;  // [m]
/// Of a single cell and scan, so that a pebble that rolls is not a bed that moves.
constexpr float greatest_evidence = 8;
/// A drift is noticed once its square exceeds share / (2 - share) of the tracked height's mean square wander.
constexpr float drift_share = 0.25F;

/// To the nearest whole number of steps.
inline std::int32_t steps_of(float metres) {
  const float bounded = metres < -longest_move  ? -longest_move
                        : metres > longest_move ? longest_move
                                                : metres;
  const float value = bounded * steps_per_metre;
  return static_cast<std::int32_t>(value + (value < 0 ? -0.5F : 0.5F));
}

inline std::int32_t bounded(std::int32_t height) {
  constexpr auto high = static_cast<std::int32_t>(fixed::greatest_height * fixed::steps_per_metre);
  return height < -high ? -high : height > high ? high : height;
}

inline float positive(float value) { return value > 0 ? value : 0; }

/// The numbers of a batch side by side, for loops that become vectors; the first eight as in FilterCell.
struct Columns {
  std::int32_t height[size];
  float rate[size], height_variance[size], covariance[size], rate_variance[size];
  float still_offset[size], still_variance[size];
  std::uint32_t count[size];
  float information[size], pull[size];
};
/// As in FilterStep.
struct StepColumns {
  float height_per_rate[size], rate_kept[size], height_variance[size], covariance[size], rate_variance[size];
  float unused[3][size];
};

constexpr std::size_t bytes_of_row = Transposition::side * sizeof(float);
static_assert(offsetof(FilterCell, weight) == bytes_of_row && sizeof(FilterStep) == bytes_of_row &&
              offsetof(Columns, information) == size * bytes_of_row &&
              sizeof(StepColumns) == size * bytes_of_row);

/// Rows of eight numbers to the first eight columns.
template <class RowAt, class Into>
AEOLIAN_INLINE void to_columns(RowAt row_at, Into* into) {
  auto* const columns = reinterpret_cast<unsigned char*>(into);
  for (std::size_t first = 0; first < size; first += Transposition::side) {
    Transposition block;
    for (std::size_t i = 0; i < Transposition::side; ++i) block.take_row(i, row_at(first + i));
    block.transpose();
    for (std::size_t k = 0; k < Transposition::side; ++k)
      block.give_row(k, columns + (k * size + first) * sizeof(float));
  }
}

AEOLIAN_INLINE void load(const CellBatch& batch, const PointScale& scale, Columns& c) {
  to_columns([&](std::size_t i) { return batch.cells[i]; }, &c);
  for (std::size_t i = 0; i < size; ++i) {
    c.information[i] = static_cast<float>(batch.cells[i]->weight * scale.information);
    c.pull[i] = static_cast<float>(batch.cells[i]->moment * scale.pull);
  }
}

AEOLIAN_INLINE void store(const Columns& c, const CellBatch& batch) {
  const auto* const columns = reinterpret_cast<const unsigned char*>(&c);
  for (std::size_t first = 0; first < size; first += Transposition::side) {
    Transposition block;
    for (std::size_t k = 0; k < Transposition::side; ++k)
      block.take_row(k, columns + (k * size + first) * sizeof(float));
    block.transpose();
    for (std::size_t i = 0; i < Transposition::side; ++i) {
      FilterCell& cell = *batch.cells[first + i];
      block.give_row(i, &cell);
      cell.weight = 0;
      cell.moment = 0;
    }
  }
}

struct Cell {
  Cell(const Columns& c, std::size_t i)
      : height(c.height[i]),
        rate(c.rate[i]),
        height_variance(c.height_variance[i]),
        covariance(c.covariance[i]),
        rate_variance(c.rate_variance[i]),
        still_offset(c.still_offset[i]),
        still_variance(c.still_variance[i]) {}
  void store(Columns& c, std::size_t i) const {
    c.height[i] = height;
    c.rate[i] = rate;
    c.height_variance[i] = height_variance;
    c.covariance[i] = covariance;
    c.rate_variance[i] = rate_variance;
    c.still_offset[i] = still_offset;
    c.still_variance[i] = still_variance;
  }
  void move(float metres) {
    const std::int32_t before = height;
    height = bounded(before + steps_of(metres));
    still_offset -= static_cast<float>(height - before) * step;
  }

  std::int32_t height;
  float rate, height_variance, covariance, rate_variance;
  float still_offset, still_variance;
};

/// Takes in all points of a scan at once, in information form. Returns how far the tracked height moves [m].
inline float update(Cell& c, float information, float pull) {
  const float gain = 1 / (1 + c.height_variance * information);
  const float still_gain = 1 / (1 + c.still_variance * information);
  const float covariance = c.covariance * gain;
  c.rate_variance = positive(c.rate_variance - c.covariance * covariance * information);
  c.rate += covariance * pull;
  c.covariance = covariance;
  c.height_variance *= gain;
  c.still_variance *= still_gain;
  c.still_offset += c.still_variance * (pull - information * c.still_offset);
  return c.height_variance * pull;
}

inline float bounded_evidence(float value) {
  return value < -greatest_evidence  ? -greatest_evidence
         : value > greatest_evidence ? greatest_evidence
                                     : value;
}

/// log(likelihood of the points under the still prediction / under the tracked one). Both are normal, of
/// variances 1 / information plus the filter's own. The logarithm is 2 artanh((b - a) / (b + a)), cut off
/// after the seventh power: exact to 4 % at a ratio of ten.
inline float evidence_of_rest(const Cell& c, float information, float pull) {
  const float tracked = 1 + c.height_variance * information;
  const float still = 1 + c.still_variance * information;
  const float still_pull = pull - information * c.still_offset;
  const float misfit = pull * pull / tracked - still_pull * still_pull / still;
  const float z = (tracked - still) / (tracked + still);
  const float z2 = z * z;
  const float log = z * (1 + z2 * (1.0F / 3 + z2 * (1.0F / 5 + z2 * (1.0F / 7))));
  return bounded_evidence(0.5F * misfit / (information > 0 ? information : 1) + log);
}

/// log(likelihood of the points if the bed has gone drift_share of the way from the still to the tracked
/// height / if it is still). On a still bed its mean is negative whatever the noise of the points: what is
/// new in them has nothing to do with where the tracking filter has gone.
inline float evidence_of_drift(const Cell& c, float information, float pull) {
  const float way = -drift_share * c.still_offset;
  const float still_pull = pull - information * c.still_offset;
  return bounded_evidence(way * (still_pull - 0.5F * information * way) /
                          (1 + c.still_variance * information));
}

inline void predict(Cell& c, float height_per_rate, float rate_kept, float height_variance, float covariance,
                    float rate_variance) {
  const float cross = c.covariance + height_per_rate * c.rate_variance;
  c.move(height_per_rate * c.rate);
  c.rate *= rate_kept;
  c.height_variance = c.height_variance > 0
                          ? c.height_variance + height_per_rate * (c.covariance + cross) + height_variance
                          : 0;
  c.covariance = rate_kept * cross + covariance;
  c.rate_variance = rate_kept * rate_kept * c.rate_variance + rate_variance;
}

AEOLIAN_WIDE_KERNEL MotionEvidence advance_all(const CellBatch& batch, const CellSteps& in,
                                               const PointScale& scale) {
  Columns columns;
  StepColumns steps;
  load(batch, scale, columns);
  to_columns([&](std::size_t i) { return &in.steps[i]; }, &steps);
  constexpr auto unit = static_cast<float>(MotionEvidence::unit);
  std::int32_t rest = 0;
  std::int32_t drift = 0;
  for (std::size_t i = 0; i < size; ++i) {
    Cell c(columns, i);
    const float information = columns.information[i];
    const float pull = columns.pull[i];
    const float still_share = in.still_share[i];
    rest += static_cast<std::int32_t>(unit * still_share * evidence_of_rest(c, information, pull));
    drift += static_cast<std::int32_t>(unit * still_share * evidence_of_drift(c, information, pull));
    c.move(update(c, information, pull));
    c.still_offset *= still_share;
    c.still_variance = still_share * c.still_variance + (1 - still_share) * c.height_variance;
    predict(c, steps.height_per_rate[i], steps.rate_kept[i], steps.height_variance[i], steps.covariance[i],
            steps.rate_variance[i]);
    c.store(columns, i);
  }
  store(columns, batch);
  return {rest, drift};
}

AEOLIAN_WIDE_KERNEL void estimate(const CellBatch& batch, const float* __restrict still_share,
                                  const PointScale& scale, CellEstimates& __restrict result) {
  Columns columns;
  load(batch, scale, columns);
  for (std::size_t i = 0; i < size; ++i) {
    Cell c(columns, i);
    const float tracked = update(c, columns.information[i], columns.pull[i]);
    const float unknown = c.height_variance > 0 ? 0 : std::numeric_limits<float>::quiet_NaN();
    const float still = c.still_offset;
    const float offset = still_share[i] > 0 ? still : tracked;
    const float variance = still_share[i] > 0 ? c.still_variance : c.height_variance;
    result.height[i] = static_cast<float>(c.height) * step + offset + unknown;
    result.variance[i] = variance + unknown;
    result.rate[i] = c.rate + unknown;
    result.rate_variance[i] = c.rate_variance + unknown;
  }
}

/// The batch with its unused part filled up.
CellBatch filled(const CellBatch& given, FilterCell& spare) {
  CellBatch batch = given;
  for (std::size_t i = given.count; i < size; ++i) batch.cells[i] = &spare;
  return batch;
}

}  // namespace

MotionEvidence advance(const CellBatch& given, CellSteps& steps, const PointScale& scale) {
  FilterCell spare;
  for (std::size_t i = given.count; i < size; ++i) {
    steps.steps[i] = {};
    steps.still_share[i] = 1;
  }
  return advance_all(filled(given, spare), steps, scale);
}

CellEstimates estimates(const CellBatch& given, const std::array<float, size>& still_share,
                        const PointScale& scale) {
  FilterCell spare;
  CellEstimates result;
  estimate(filled(given, spare), still_share.data(), scale, result);
  return result;
}

}  // namespace aeolian
