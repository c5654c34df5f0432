#include "aeolian_core/twin/difference.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/kernel.hpp"
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

/// A layer made of two others block by block, so that its memory, that of `reused` if it suffices, is touched
/// once.
template <class Work>
HeightMap::Layer combined(const HeightMap::Layer& a, const HeightMap::Layer& b, Work&& work,
                          HeightMap::Layer reused = {}) {
  require_same_size(a, b);
  HeightMap::Layer result = std::move(reused);
  result.clear();
  result.reserve(a.size());
  std::array<float, block> values;
  for (std::size_t at = 0; at < a.size(); at += block) {
    const std::size_t count = std::min(block, a.size() - at);
    work(&a[at], &b[at], count, values.data());
    result.insert(result.end(), values.begin(), values.begin() + static_cast<std::ptrdiff_t>(count));
  }
  return result;
}

/// Some lanes at once.
constexpr std::size_t width = 4;
using Floats = float __attribute__((vector_size(width * sizeof(float))));
using Doubles = double __attribute__((vector_size(width * sizeof(double))));
using Ints = std::int32_t __attribute__((vector_size(width * sizeof(std::int32_t))));

/// Sums of a block, lane by lane.
struct Partial {
  Doubles values[lanes / width] = {};

  AEOLIAN_INLINE void add(std::size_t part, Floats to_add) {
    values[part] += __builtin_convertvector(to_add, Doubles);
  }
  AEOLIAN_INLINE void add_squares(std::size_t part, Floats roots) {
    const Doubles value = __builtin_convertvector(roots, Doubles);
    values[part] += value * value;
  }
  void add_to(Sums& sums) const {
    for (std::size_t lane = 0; lane < lanes; ++lane) sums[lane] += values[lane / width][lane % width];
  }
};

AEOLIAN_INLINE Floats load(const float* from) {
  Floats result;
  std::memcpy(&result, from, sizeof result);
  return result;
}
AEOLIAN_INLINE Floats where(Ints is, Floats values) { return is ? values : Floats{}; }

/// How many lanes of a mask's sum (-1: one) are set.
std::size_t count(Ints set) {
  std::int32_t sum = 0;
  for (std::size_t lane = 0; lane < width; ++lane) sum -= set[lane];
  return static_cast<std::size_t>(sum);
}

/// Sums over the known differences.
struct Moments {
  std::size_t cells = 0;
  Sums sum{}, sum_of_squares{};
};

AEOLIAN_KERNEL void add(const float* __restrict d, Moments& __restrict to) {
  Partial sum, squares;
  Ints cells{};
  for (std::size_t i = 0; i < block; i += lanes)
    for (std::size_t part = 0; part < lanes / width; ++part) {
      const Floats value = load(d + i + part * width);
      const Ints is_known = (value <= greatest) & (-value <= greatest);
      sum.add(part, where(is_known, value));
      squares.add_squares(part, where(is_known, value));
      cells += is_known;
    }
  sum.add_to(to.sum);
  squares.add_to(to.sum_of_squares);
  to.cells += count(cells);
}

/// What was gained and lost beyond the level of detection, and the squares of those levels.
struct Changes {
  std::size_t cells = 0;
  Sums gained{}, lost{}, squared_gained_levels{}, squared_lost_levels{};
};

AEOLIAN_KERNEL void add(const float* __restrict d, const float* __restrict lod, Changes& __restrict to) {
  Partial gained, lost, gained_levels, lost_levels;
  Ints cells{};
  for (std::size_t i = 0; i < block; i += lanes)
    for (std::size_t part = 0; part < lanes / width; ++part) {
      const Floats value = load(d + i + part * width);
      const Floats level = load(lod + i + part * width);
      const Ints gains = value > level;
      const Ints loses = -value > level;
      gained.add(part, where(gains, value));
      lost.add(part, where(loses, -value));
      gained_levels.add_squares(part, where(gains, level));
      lost_levels.add_squares(part, where(loses, level));
      cells += gains | loses;
    }
  gained.add_to(to.gained);
  lost.add_to(to.lost);
  gained_levels.add_to(to.squared_gained_levels);
  lost_levels.add_to(to.squared_lost_levels);
  to.cells += count(cells);
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
      difference.size(), [&](const float* d) { add(d, moments); }, difference);
  const auto count = static_cast<double>(moments.cells);
  DifferenceStatistics result;
  result.cells = moments.cells;
  result.bias = total(moments.sum) / count;
  result.rmse = std::sqrt(total(moments.sum_of_squares) / count);
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

HeightMap difference_map(const HeightMap& a, const HeightMap& b, HeightMap reused) {
  if (a.geometry().nx() != b.geometry().nx())
    throw Error("difference: the maps have rows of " + std::to_string(a.geometry().nx()) + " and " +
                std::to_string(b.geometry().nx()) + " cells, must be of the same grid");
  const auto memory = [&](const std::string& name) {
    return reused.has(name) ? std::move(reused.layer(name)) : HeightMap::Layer();
  };
  HeightMap result(a.geometry());
  result.add(layer::difference, combined(a.layer(layer::elevation), b.layer(layer::elevation), subtract,
                                         memory(layer::difference)));
  const bool of_a = a.has(layer::variance);
  const bool of_b = b.has(layer::variance);
  if (!of_a && !of_b) return result;
  const HeightMap::Layer exact(of_a && of_b ? 0 : a.geometry().size(), 0);
  result.add(layer::lod95, combined(of_a ? a.layer(layer::variance) : exact,
                                    of_b ? b.layer(layer::variance) : exact, detect, memory(layer::lod95)));
  return result;
}

SignificantChange significant_change(const HeightMap& difference) {
  const HeightMap::Layer& d = difference.layer(layer::difference);
  const HeightMap::Layer& lod = difference.layer(layer::lod95);
  Changes changes;
  for_each_block(
      d.size(), [&](const float* values, const float* levels) { add(values, levels, changes); }, d, lod);
  const double area = difference.geometry().cell() * difference.geometry().cell();
  const auto sigma = [&](const Sums& squared_levels) {
    return area * std::sqrt(total(squared_levels)) / static_cast<double>(sigmas_of_95_percent);
  };
  SignificantChange result;
  result.cells = changes.cells;
  result.area = area * static_cast<double>(changes.cells);
  result.deposition = area * total(changes.gained);
  result.erosion = area * total(changes.lost);
  result.deposition_sigma = sigma(changes.squared_gained_levels);
  result.erosion_sigma = sigma(changes.squared_lost_levels);
  return result;
}

}  // namespace aeolian
