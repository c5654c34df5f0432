#include "aeolian_core/measure/tile_filter.hpp"

#include <algorithm>
#include <iterator>

#include "aeolian_core/measure/kernel.hpp"

namespace aeolian {
namespace {

constexpr std::size_t cells = TileFilter::cells;
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

}  // namespace

// The update by all points of a scan at once, in information form.
AEOLIAN_KERNEL TileMotion close_scan(TileFilter& f, bool still, float weight_scale,
                                     float known_rate_variance) {
  const double information_of_weight = 1 / static_cast<double>(weight_scale);
  const double pull_of_moment = fixed::step * information_of_weight;
  std::int32_t moving_cells = 0;
  std::int32_t rates = 0;
  std::int32_t drifts = 0;
  const float still_share = still ? 1 : 0;
  const float moving_share = still ? 0 : 1;
  for (std::size_t i = 0; i < cells; ++i) {
    const auto information = static_cast<float>(f.weight[i] * information_of_weight);
    const auto pull = static_cast<float>(f.moment[i] * pull_of_moment);
    const float p00 = f.height_variance[i];
    const float p01 = f.covariance[i];
    const float ps = f.still_variance[i];
    const float gain = 1 / (1 + p00 * information);
    const float still_gain = 1 / (1 + ps * information);
    const float variance = p00 * gain;
    const float rate = f.rate[i] + p01 * gain * pull;
    const float rate_variance = positive(f.rate_variance[i] - p01 * p01 * gain * information);
    const std::int32_t before = f.height[i];
    const std::int32_t height = bounded(before + steps(variance * pull));
    const float offset = f.still_offset[i];
    const float still_offset =
        offset + ps * still_gain * (pull - information * offset) - static_cast<float>(height - before) * step;
    f.height[i] = height;
    f.height_variance[i] = variance;
    f.covariance[i] = p01 * gain;
    f.rate[i] = rate;
    f.rate_variance[i] = rate_variance;
    f.still_offset[i] = still_share * still_offset;
    f.still_variance[i] = still_share * (ps * still_gain) + moving_share * variance;

    float counts = information > 0 ? 1.0F : 0.0F;
    counts = rate_variance > 0 ? counts : 0;
    counts = rate_variance < known_rate_variance ? counts : 0;
    const float r = counts * rate * rate / (rate_variance > 0 ? rate_variance : 1);
    const float d = counts * still_offset * still_offset / (variance > 0 ? variance : 1);
    moving_cells += static_cast<std::int32_t>(counts);
    rates += static_cast<std::int32_t>(at_most(r, motion_bound) * TileMotion::unit);
    drifts += static_cast<std::int32_t>(at_most(d, motion_bound) * TileMotion::unit);
  }
  std::fill(std::begin(f.weight), std::end(f.weight), 0.0);
  std::fill(std::begin(f.moment), std::end(f.moment), 0.0);
  return {moving_cells, rates, drifts};
}

AEOLIAN_KERNEL void predict(TileFilter& f, const HeightStep& bed) {
  const auto l = static_cast<float>(bed.height_per_rate);
  const auto k = static_cast<float>(bed.rate_kept);
  const auto q00 = static_cast<float>(bed.height_variance);
  const auto q01 = static_cast<float>(bed.covariance);
  const auto q11 = static_cast<float>(bed.rate_variance);
  for (std::size_t i = 0; i < cells; ++i) {
    const float p00 = f.height_variance[i];
    const float p01 = f.covariance[i];
    const float p11 = f.rate_variance[i];
    const std::int32_t before = f.height[i];
    const std::int32_t height = bounded(before + steps(l * f.rate[i]));
    f.height[i] = height;
    f.still_offset[i] -= static_cast<float>(height - before) * step;
    f.rate[i] *= k;
    f.height_variance[i] = p00 > 0 ? p00 + l * (2 * p01 + l * p11) + q00 : 0;
    f.covariance[i] = k * (p01 + l * p11) + q01;
    f.rate_variance[i] = k * k * p11 + q11;
  }
}

AEOLIAN_KERNEL void estimate(const TileFilter& __restrict f, bool still, float weight_scale,
                             TileEstimate& __restrict result) {
  const double information_of_weight = 1 / static_cast<double>(weight_scale);
  const double pull_of_moment = fixed::step * information_of_weight;
  const bool speaks = still;
  for (std::size_t i = 0; i < cells; ++i) {
    const auto information = static_cast<float>(f.weight[i] * information_of_weight);
    const auto pull = static_cast<float>(f.moment[i] * pull_of_moment);
    const float p00 = f.height_variance[i];
    const float p01 = f.covariance[i];
    const float ps = f.still_variance[i];
    const float gain = 1 / (1 + p00 * information);
    const float still_gain = 1 / (1 + ps * information);
    const float offset = f.still_offset[i];
    const float tracked = p00 * gain * pull;
    const float rested = offset + ps * still_gain * (pull - information * offset);
    result.information[i] = information;
    result.height[i] = static_cast<float>(f.height[i]) * step + (speaks ? rested : tracked);
    result.variance[i] = speaks ? ps * still_gain : p00 * gain;
    result.rate[i] = f.rate[i] + p01 * gain * pull;
    result.rate_variance[i] = positive(f.rate_variance[i] - p01 * p01 * gain * information);
  }
}

// All cells are written, the others with what they hold: masked stores are slow on some processors.
AEOLIAN_KERNEL void write_touched(const TileEstimate& __restrict estimate, const float* __restrict values,
                                  float* __restrict layer, const TileWindow& window) {
  constexpr std::size_t side = TileFilter::side;
  for (std::size_t row = 0; row < window.rows; ++row) {
    const float* __restrict information = estimate.information + row * side;
    const float* __restrict from = values + row * side;
    float* __restrict to = layer + row * window.stride;
    for (std::size_t column = 0; column < window.columns; ++column)
      to[column] = information[column] > 0 ? from[column] : to[column];
  }
}

}  // namespace aeolian
