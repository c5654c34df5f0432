#include "aeolian_core/measure/tile_filter.hpp"

#include <algorithm>
#include <iterator>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr std::size_t cells = FilterRow::cells;
constexpr auto step = static_cast<float>(fixed::step);
constexpr auto steps_per_metre = static_cast<float>(fixed::steps_per_metre);
/// Fixed-point heights stay within this far from the bound of 32 bits, whatever a rate says.
constexpr float longest_move = 1000;  // [m]
constexpr float motion_bound = 64;

/// To the nearest whole number of steps.
inline std::int32_t steps(float metres) {
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

inline float at_most(float value, float bound) { return value < bound ? value : bound; }
inline float positive(float value) { return value > 0 ? value : 0; }

struct Cell {
  Cell(const FilterRow& row, std::size_t i)
      : height(row.height[i]),
        rate(row.rate[i]),
        height_variance(row.height_variance[i]),
        covariance(row.covariance[i]),
        rate_variance(row.rate_variance[i]),
        still_offset(row.still_offset[i]),
        still_variance(row.still_variance[i]) {}
  void store(FilterRow& row, std::size_t i) const {
    row.height[i] = height;
    row.rate[i] = rate;
    row.height_variance[i] = height_variance;
    row.covariance[i] = covariance;
    row.rate_variance[i] = rate_variance;
    row.still_offset[i] = still_offset;
    row.still_variance[i] = still_variance;
  }
  void move(float metres) {
    const std::int32_t before = height;
    height = bounded(before + steps(metres));
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

struct Bed {
  explicit Bed(const HeightStep& in)
      : height_per_rate(static_cast<float>(in.height_per_rate)),
        rate_kept(static_cast<float>(in.rate_kept)),
        height_variance(static_cast<float>(in.height_variance)),
        covariance(static_cast<float>(in.covariance)),
        rate_variance(static_cast<float>(in.rate_variance)) {}
  float height_per_rate, rate_kept, height_variance, covariance, rate_variance;
};

inline void predict(Cell& c, const Bed& bed) {
  const float l = bed.height_per_rate;
  const float k = bed.rate_kept;
  const float cross = c.covariance + l * c.rate_variance;
  c.move(l * c.rate);
  c.rate *= k;
  c.height_variance =
      c.height_variance > 0 ? c.height_variance + l * (c.covariance + cross) + bed.height_variance : 0;
  c.covariance = k * cross + bed.covariance;
  c.rate_variance = k * k * c.rate_variance + bed.rate_variance;
}

inline float information_of(const FilterRow& row, std::size_t i, const PointScale& scale) {
  return static_cast<float>(row.weight[i] * scale.information);
}
inline float pull_of(const FilterRow& row, std::size_t i, const PointScale& scale) {
  return static_cast<float>(row.moment[i] * scale.pull);
}

}  // namespace

AEOLIAN_KERNEL TileMotion close_scan(FilterRow& row, bool still, const PointScale& scale,
                                     float known_rate_variance, const HeightStep& time) {
  const Bed bed(time);
  std::int32_t moving_cells = 0;
  std::int32_t rates = 0;
  std::int32_t drifts = 0;
  const float still_share = still ? 1 : 0;
  const float moving_share = still ? 0 : 1;
  for (std::size_t i = 0; i < cells; ++i) {
    const float information = information_of(row, i, scale);
    Cell c(row, i);
    c.move(update(c, information, pull_of(row, i, scale)));

    float counts = information > 0 ? 1.0F : 0.0F;
    counts = c.rate_variance > 0 ? counts : 0;
    counts = c.rate_variance < known_rate_variance ? counts : 0;
    const float r = counts * c.rate * c.rate / (c.rate_variance > 0 ? c.rate_variance : 1);
    const float d =
        counts * c.still_offset * c.still_offset / (c.height_variance > 0 ? c.height_variance : 1);
    moving_cells += static_cast<std::int32_t>(counts);
    rates += static_cast<std::int32_t>(at_most(r, motion_bound) * TileMotion::unit);
    drifts += static_cast<std::int32_t>(at_most(d, motion_bound) * TileMotion::unit);

    c.still_offset *= still_share;
    c.still_variance = still_share * c.still_variance + moving_share * c.height_variance;
    predict(c, bed);
    c.store(row, i);
    row.weight[i] = 0;
    row.moment[i] = 0;
  }
  return {moving_cells, rates, drifts};
}

AEOLIAN_KERNEL void predict(FilterRow& row, const HeightStep& time, bool restart_still) {
  const Bed bed(time);
  const float still_share = restart_still ? 0 : 1;
  const float tracked_share = restart_still ? 1 : 0;
  for (std::size_t i = 0; i < cells; ++i) {
    Cell c(row, i);
    predict(c, bed);
    c.still_offset *= still_share;
    c.still_variance = still_share * c.still_variance + tracked_share * c.height_variance;
    c.store(row, i);
  }
}

AEOLIAN_KERNEL void write_estimates(const FilterRow& row, bool still, const PointScale& scale,
                                    const RowLayers& layers, std::size_t columns) {
  float information[cells], height[cells], variance[cells], rate[cells], rate_variance[cells];
  const bool speaks = still;
  for (std::size_t i = 0; i < cells; ++i) {
    Cell c(row, i);
    information[i] = information_of(row, i, scale);
    const float tracked = update(c, information[i], pull_of(row, i, scale));
    height[i] = static_cast<float>(c.height) * step + (speaks ? c.still_offset : tracked);
    variance[i] = speaks ? c.still_variance : c.height_variance;
    rate[i] = c.rate;
    rate_variance[i] = c.rate_variance;
  }
  // All cells are written, the others with what they hold: masked stores are slow on some processors.
  const auto write_seen = [&](const float* __restrict values, float* __restrict layer) {
    for (std::size_t i = 0; i < columns; ++i) layer[i] = information[i] > 0 ? values[i] : layer[i];
  };
  write_seen(height, layers.elevation);
  write_seen(variance, layers.variance);
  write_seen(rate, layers.rate);
  write_seen(rate_variance, layers.rate_variance);
}

CellEstimate estimate(const FilterRow& row, std::size_t column, bool still, const PointScale& scale) {
  Cell c(row, column);
  const float tracked = update(c, information_of(row, column, scale), pull_of(row, column, scale));
  const float height = static_cast<float>(c.height) * step + (still ? c.still_offset : tracked);
  return {static_cast<double>(height), static_cast<double>(still ? c.still_variance : c.height_variance),
          static_cast<double>(c.rate), static_cast<double>(c.rate_variance)};
}

}  // namespace aeolian
