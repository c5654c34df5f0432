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

/// Running mean over 2 half + 1 rows, for all columns at the same time.
std::vector<double> box_mean_of_rows(const GridGeometry& g, const std::vector<double>& values, int half,
                                     bool periodic) {
  const int n = g.ny();
  const auto nx = static_cast<std::size_t>(g.nx());
  std::vector<double> sums(nx, 0.0);
  std::vector<double> result(values.size());
  const auto add = [&](int y, double sign) {
    if (!periodic && (y < 0 || y >= n)) return;
    const double* const row = &values[g.index(0, (y % n + n) % n)];
    for (std::size_t x = 0; x < nx; ++x) sums[x] += sign * row[x];
  };
  for (int y = -half; y < half; ++y) add(y, 1);
  for (int y = 0; y < n; ++y) {
    add(y + half, 1);
    const int count = periodic ? 2 * half + 1 : std::min(y + half + 1, n) - std::max(y - half, 0);
    double* const row = &result[g.index(0, y)];
    for (std::size_t x = 0; x < nx; ++x) row[x] = sums[x] / count;
    add(y - half, -1);
  }
  return result;
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
    result = box_mean_of_rows(g, result, half, periodic);
  }
  return result;
}

}  // namespace aeolian
