#include "aeolian_core/bedforms/height_map/relief.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

std::vector<double> plane(const GridGeometry& g, const std::vector<double>& height, bool flat) {
  // About the grid's middle the two slopes and the mean do not depend on one another.
  const double middle_x = 0.5 * (g.nx() - 1);
  const double middle_y = 0.5 * (g.ny() - 1);
  double mean = 0, xz = 0, yz = 0, xx = 0, yy = 0;
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const double h = height[g.index(x, y)];
      mean += h / static_cast<double>(g.size());
      xz += (x - middle_x) * h;
      yz += (y - middle_y) * h;
      xx += (x - middle_x) * (x - middle_x);
      yy += (y - middle_y) * (y - middle_y);
    }
  const double slope_x = flat || xx == 0 ? 0 : xz / xx;
  const double slope_y = flat || yy == 0 ? 0 : yz / yy;
  std::vector<double> result(height.size());
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      result[g.index(x, y)] = mean + slope_x * (x - middle_x) + slope_y * (y - middle_y);
  return result;
}

constexpr int lanes = 16;  ///< lines that are smoothed side by side

/// Running means over 2 half + 1 values of each line, wrapped or cut off at the ends. A line's values lie
/// `lanes` apart.
AEOLIAN_KERNEL void box_mean(int n, int half, bool periodic, const double* __restrict values,
                             double* __restrict means) {
  double sums[lanes] = {};
  const auto add = [&](int i, double sign) {
    if (!periodic && (i < 0 || i >= n)) return;
    const double* const line = values + std::ptrdiff_t{(i % n + n) % n} * lanes;
    for (int k = 0; k < lanes; ++k) sums[k] += sign * line[k];
  };
  for (int i = -half; i < half; ++i) add(i, 1);
  for (int i = 0; i < n; ++i) {
    add(i + half, 1);
    const int count = periodic ? 2 * half + 1 : std::min(i + half + 1, n) - std::max(i - half, 0);
    const double share = 1.0 / count;
    for (int k = 0; k < lanes; ++k) means[i * lanes + k] = sums[k] * share;
    add(i - half, -1);
  }
}

/// Three box means along all lines of n values `along` apart; `lines` lines lie `across` apart.
void smooth(std::vector<double>& values, int n, std::size_t along, int lines, std::size_t across, int half,
            bool periodic) {
  tbb::parallel_for(0, (lines + lanes - 1) / lanes, [&](int block) {
    const int first = block * lanes;
    const int count = std::min(lanes, lines - first);
    std::vector<double> here(static_cast<std::size_t>(n) * lanes, 0.0);
    std::vector<double> next(here.size());
    // By squares, each along what lies side by side: a cache holds no more of what lies far apart.
    const auto for_values = [&](auto&& visit) {
      const auto visit_one = [&](int i, int k) {
        visit(values[static_cast<std::size_t>(i) * along + static_cast<std::size_t>(first + k) * across],
              here[static_cast<std::size_t>(i) * lanes + static_cast<std::size_t>(k)]);
      };
      for (int from = 0; from < n; from += lanes) {
        const int to = std::min(from + lanes, n);
        if (along < across)
          for (int k = 0; k < count; ++k)
            for (int i = from; i < to; ++i) visit_one(i, k);
        else
          for (int i = from; i < to; ++i)
            for (int k = 0; k < count; ++k) visit_one(i, k);
      }
    };
    for_values([](const double& value, double& mine) { mine = value; });
    for (int pass = 0; pass < 3; ++pass) {
      box_mean(n, half, periodic, here.data(), next.data());
      here.swap(next);
    }
    for_values([](double& value, const double& mine) { value = mine; });
  });
}

}  // namespace

std::vector<double> dune_surface(const GridGeometry& g, const std::vector<double>& height, double scale,
                                 bool periodic) {
  if (std::min(g.length_x(), g.length_y()) < 2 * scale) return plane(g, height, periodic);
  std::vector<double> result = height;
  const int half = static_cast<int>(std::lround(scale / g.cell() / 2));
  const auto row = static_cast<std::size_t>(g.nx());
  smooth(result, g.nx(), 1, g.ny(), row, half, periodic);
  smooth(result, g.ny(), row, g.nx(), 1, half, periodic);
  return result;
}

}  // namespace aeolian
