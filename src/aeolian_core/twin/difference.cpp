#include "aeolian_core/twin/difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "aeolian_core/measure/kernel.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/quantile.hpp"

namespace aeolian {
namespace {

constexpr double mad_to_sigma = 1.4826;  // of a normal distribution
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

struct Moments {
  std::int64_t cells = 0;
  Sums sum{};
  Sums sum_of_squares{};
};

AEOLIAN_KERNEL void add_moments(const float* __restrict d, Moments& __restrict moments) {
  std::int32_t cells = 0;
  Sums sum = moments.sum;
  Sums sum_of_squares = moments.sum_of_squares;
  for (std::size_t i = 0; i < block; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const float value = d[i + lane];
      const double counted = static_cast<double>(known(value) ? value : 0);
      cells += known(value) ? 1 : 0;
      sum[lane] += counted;
      sum_of_squares[lane] += counted * counted;
    }
  moments.cells += cells;
  moments.sum = sum;
  moments.sum_of_squares = sum_of_squares;
}

struct Changes {
  std::int64_t cells = 0;
  Sums gained{}, lost{};                    ///< [m]
  Sums gained_variance{}, lost_variance{};  ///< of lod95 [m^2]
};

AEOLIAN_KERNEL void add_changes(const float* __restrict d, const float* __restrict lod,
                                Changes& __restrict changes) {
  std::int32_t cells = 0;
  Changes sums = changes;
  for (std::size_t i = 0; i < block; i += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const float value = d[i + lane];
      const float level = lod[i + lane];
      const bool gained = value > level;
      const bool lost = -value > level;
      const auto variance = static_cast<double>(level * level);
      cells += gained | lost ? 1 : 0;
      sums.gained[lane] += gained ? static_cast<double>(value) : 0;
      sums.lost[lane] += lost ? static_cast<double>(-value) : 0;
      sums.gained_variance[lane] += gained ? variance : 0;
      sums.lost_variance[lane] += lost ? variance : 0;
    }
  sums.cells += cells;
  changes = sums;
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
  Moments moments;
  for_each_block(
      difference.size(), [&](const float* d) { add_moments(d, moments); }, difference);
  DifferenceStatistics result;
  result.cells = static_cast<std::size_t>(moments.cells);
  const auto count = static_cast<double>(result.cells);
  result.bias = total(moments.sum) / count;
  result.rmse = std::sqrt(total(moments.sum_of_squares) / count);
  const double middle = quantile_of(difference, result.cells, 0.5);
  result.nmad = mad_to_sigma * quantile_of_distances(difference, result.cells, 0.5, middle);
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
  Changes changes;
  for_each_block(
      d.size(), [&](const float* values, const float* levels) { add_changes(values, levels, changes); }, d,
      lod);
  const double area = difference.geometry().cell() * difference.geometry().cell();
  const auto sigma = [&](const Sums& squared_levels) {
    return area * std::sqrt(total(squared_levels)) / static_cast<double>(sigmas_of_95_percent);
  };
  SignificantChange result;
  result.cells = static_cast<std::size_t>(changes.cells);
  result.area = area * static_cast<double>(result.cells);
  result.deposition = area * total(changes.gained);
  result.erosion = area * total(changes.lost);
  result.deposition_sigma = sigma(changes.gained_variance);
  result.erosion_sigma = sigma(changes.lost_variance);
  return result;
}

}  // namespace aeolian
