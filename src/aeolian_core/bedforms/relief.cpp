#include "aeolian_core/bedforms/relief.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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

/// Running mean over 2 half + 1 values of a row, wrapped or cut off at its ends.
void box_mean(std::vector<double>& row, int half, bool periodic, std::vector<double>& sums) {
  const int n = static_cast<int>(row.size());
  const int margin = periodic ? half : 0;
  sums.assign(static_cast<std::size_t>(n + 2 * margin) + 1, 0.0);
  for (int i = -margin; i < n + margin; ++i)
    sums[static_cast<std::size_t>(i + margin) + 1] =
        sums[static_cast<std::size_t>(i + margin)] + row[static_cast<std::size_t>((i % n + n) % n)];
  for (int i = 0; i < n; ++i) {
    const int from = std::max(i - half, -margin);
    const int to = std::min(i + half + 1, n + margin);
    row[static_cast<std::size_t>(i)] =
        (sums[static_cast<std::size_t>(to + margin)] - sums[static_cast<std::size_t>(from + margin)]) /
        (to - from);
  }
}

}  // namespace

std::vector<double> dune_surface(const GridGeometry& g, const std::vector<double>& height, double scale,
                                 bool periodic) {
  if (std::min(g.length_x(), g.length_y()) < 2 * scale) return plane(g, height, periodic);
  std::vector<double> result = height;
  std::vector<double> row, sums;
  const int half = static_cast<int>(std::lround(scale / g.cell() / 2));
  for (int pass = 0; pass < 3; ++pass) {
    for (int y = 0; y < g.ny(); ++y) {
      const auto first = result.begin() + static_cast<std::ptrdiff_t>(g.index(0, y));
      row.assign(first, first + g.nx());
      box_mean(row, half, periodic, sums);
      std::copy(row.begin(), row.end(), first);
    }
    for (int x = 0; x < g.nx(); ++x) {
      row.clear();
      for (int y = 0; y < g.ny(); ++y) row.push_back(result[g.index(x, y)]);
      box_mean(row, half, periodic, sums);
      for (int y = 0; y < g.ny(); ++y) result[g.index(x, y)] = row[static_cast<std::size_t>(y)];
    }
  }
  return result;
}

}  // namespace aeolian
