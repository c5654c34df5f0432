#include "aeolian_core/twin/difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "aeolian_core/surface/kernel.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_core/twin/quantile.hpp"

namespace aeolian {
namespace {

constexpr float sigmas_of_95_percent = 1.96F;
constexpr float greatest = std::numeric_limits<float>::max();

/// Cells worked on at once, in the fast cache; the layers' last block is filled up with unknown cells.
constexpr std::size_t block = 2048;
/// Partial sums side by side, so that vectors can add them, in one order on every machine.
constexpr std::size_t lanes = 8;
using Sums = std::array<double, lanes>;

double total(const Sums& sums) { return std::accumulate(sums.begin(), sums.end(), 0.0); }

void require_same_size(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  if (a.size() != b.size())
    throw Error("difference: the surfaces have " + std::to_string(a.size()) + " and " +
                std::to_string(b.size()) + " cells, must be of the same grid");
}

inline bool known(float value) { return std::abs(value) <= greatest; }

AEOLIAN_KERNEL void subtract(const float* __restrict a, const float* __restrict b, std::size_t count,
                             float* __restrict result) {
  for (std::size_t i = 0; i < count; ++i) {
    const float d = a[i] - b[i];
    result[i] = known(d) ? d : HeightMap::unknown;
  }
}

AEOLIAN_KERNEL void detect(const float* __restrict a, const float* __restrict b, std::size_t count,
                           float* __restrict result) {
  for (std::size_t i = 0; i < count; ++i) result[i] = sigmas_of_95_percent * std::sqrt(a[i] + b[i]);
}

/// A layer made of two others block by block, so that its memory is touched once.
template <class Work>
HeightMap::Layer combined(const HeightMap::Layer& a, const HeightMap::Layer& b, Work&& work) {
  require_same_size(a, b);
  HeightMap::Layer result;
  result.reserve(a.size());
  std::array<float, block> values;
  for (std::size_t at = 0; at < a.size(); at += block) {
    const std::size_t count = std::min(block, a.size() - at);
    work(&a[at], &b[at], count, values.data());
    result.insert(result.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return result;
}

AEOLIAN_KERNEL void add(const float* __restrict values, Sums& __restrict sums) {
  double partial[lanes] = {};
  for (std::size_t i = 0; i < block; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) partial[lane] += static_cast<double>(values[i + lane]);
  for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += partial[lane];
}

AEOLIAN_KERNEL void add_squares(const float* __restrict values, Sums& __restrict sums) {
  double partial[lanes] = {};
  for (std::size_t i = 0; i < block; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto value = static_cast<double>(values[i + lane]);
      partial[lane] += value * value;
    }
  for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += partial[lane];
}

/// Copies a block with zeros for unknown values; how many are known.
AEOLIAN_KERNEL std::int32_t take_known(const float* __restrict d, float* __restrict values) {
  std::int32_t cells = 0;
  for (std::size_t i = 0; i < block; ++i) {
    values[i] = known(d[i]) ? d[i] : 0;
    cells += known(d[i]) ? 1 : 0;
  }
  return cells;
}

/// What a block gained and lost beyond the level of detection, zero elsewhere [m].
struct Changes {
  float gained[block], lost[block];
  float gained_level[block], lost_level[block];
};

AEOLIAN_KERNEL std::int32_t find_changes(const float* __restrict d, const float* __restrict lod,
                                         Changes& __restrict changes) {
  std::int32_t cells = 0;
  for (std::size_t i = 0; i < block; ++i) {
    const float value = d[i];
    const float level = lod[i];
    changes.gained[i] = value > level ? value : 0;
    changes.lost[i] = -value > level ? -value : 0;
    changes.gained_level[i] = value > level ? level : 0;
    changes.lost_level[i] = -value > level ? level : 0;
    cells += std::abs(value) > level ? 1 : 0;
  }
  return cells;
}

/// Calls `work(values of each layer)` for blocks of them, the last filled up.
template <class Work, class... Layers>
void for_each_block(std::size_t count, Work&& work, const Layers&... layers) {
  const std::size_t whole = count / block * block;
  for (std::size_t at = 0; at < whole; at += block) work(&layers[at]...);
  const auto last = [&](const HeightMap::Layer& layer) {
    std::array<float, block> values;
    values.fill(HeightMap::unknown);
    std::copy(layer.begin() + static_cast<std::ptrdiff_t>(whole), layer.end(), values.begin());
    return values;
  };
  if (whole < count) work(last(layers).data()...);
}

}  // namespace

DifferenceStatistics difference_statistics(const HeightMap::Layer& difference) {
  DifferenceStatistics result;
  Sums sum{};
  Sums sum_of_squares{};
  const auto add_block = [&](const float* d) {
    std::array<float, block> values;
    result.cells += static_cast<std::size_t>(take_known(d, values.data()));
    add(values.data(), sum);
    add_squares(values.data(), sum_of_squares);
  };
  for_each_block(difference.size(), add_block, difference);
  const auto count = static_cast<double>(result.cells);
  result.bias = total(sum) / count;
  result.rmse = std::sqrt(total(sum_of_squares) / count);
  const double middle = quantile_of(difference, result.cells, 0.5);
  result.nmad = sigma_per_median * quantile_of_distances(difference, result.cells, 0.5, middle);
  return result;
}

DifferenceStatistics difference_statistics(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  return difference_statistics(difference(a, b));
}

HeightMap::Layer difference(const HeightMap::Layer& a, const HeightMap::Layer& b) {
  return combined(a, b, subtract);
}

HeightMap::Layer level_of_detection(const HeightMap::Layer& variance_a, const HeightMap::Layer& variance_b) {
  return combined(variance_a, variance_b, detect);
}

HeightMap difference_map(const HeightMap& a, const HeightMap& b) {
  if (a.geometry().nx() != b.geometry().nx())
    throw Error("difference: the maps have rows of " + std::to_string(a.geometry().nx()) + " and " +
                std::to_string(b.geometry().nx()) + " cells, must be of the same grid");
  HeightMap result(a.geometry());
  result.add(layer::difference, difference(a.layer(layer::elevation), b.layer(layer::elevation)));
  const bool of_a = a.has(layer::variance);
  const bool of_b = b.has(layer::variance);
  if (!of_a && !of_b) return result;
  const HeightMap::Layer exact(of_a && of_b ? 0 : a.geometry().size(), 0);
  result.add(layer::lod95, level_of_detection(of_a ? a.layer(layer::variance) : exact,
                                              of_b ? b.layer(layer::variance) : exact));
  return result;
}

SignificantChange significant_change(const HeightMap& difference) {
  const HeightMap::Layer& d = difference.layer(layer::difference);
  const HeightMap::Layer& lod = difference.layer(layer::lod95);
  SignificantChange result;
  Sums gained{}, lost{}, squared_gained_levels{}, squared_lost_levels{};
  const auto add_block = [&](const float* values, const float* levels) {
    Changes changes;
    result.cells += static_cast<std::size_t>(find_changes(values, levels, changes));
    add(changes.gained, gained);
    add(changes.lost, lost);
    add_squares(changes.gained_level, squared_gained_levels);
    add_squares(changes.lost_level, squared_lost_levels);
  };
  for_each_block(d.size(), add_block, d, lod);
  const double area = difference.geometry().cell() * difference.geometry().cell();
  const auto sigma = [&](const Sums& squared_levels) {
    return area * std::sqrt(total(squared_levels)) / static_cast<double>(sigmas_of_95_percent);
  };
  result.area = area * static_cast<double>(result.cells);
  result.deposition = area * total(gained);
  result.erosion = area * total(lost);
  result.deposition_sigma = sigma(squared_gained_levels);
  result.erosion_sigma = sigma(squared_lost_levels);
  return result;
}

}  // namespace aeolian
