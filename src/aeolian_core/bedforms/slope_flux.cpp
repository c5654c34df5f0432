#include "aeolian_core/bedforms/slope_flux.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

/// One explicit step; `gain` is scale dt / (2 cell^2): a face's activity is the mean of its two cells'.
void substep(const WindFrame& frame, double gain, const std::vector<double>& activity,
             std::vector<double>& height, std::vector<double>& next) {
  const std::size_t n = frame.stations();
  const std::size_t rows = frame.rows();
  const bool periodic = frame.periodic();
  next = height;
  const auto exchange = [&](std::size_t a, std::size_t b) {
    const double flow = gain * (activity[a] + activity[b]) * (height[a] - height[b]);
    next[a] -= flow;
    next[b] += flow;
  };
  for (std::size_t row = 0; row < rows; ++row) {
    const std::size_t first = row * n;
    for (std::size_t i = 0; i + 1 < n; ++i) exchange(first + i, first + i + 1);
    if (periodic && n > 1) exchange(first + n - 1, first);
  }
  const std::size_t faces = periodic && rows > 1 ? rows : rows - 1;
  for (std::size_t row = 0; row < faces; ++row) {
    const std::size_t first = row * n;
    const std::size_t other = row + 1 == rows ? 0 : first + n;
    for (std::size_t i = 0; i < n; ++i) exchange(first + i, other + i);
  }
  height.swap(next);
}

}  // namespace

void apply_slope_flux(const WindFrame& frame, double cell, double scale, const std::vector<double>& activity,
                      double duration, std::vector<double>& height, std::vector<double>& scratch) {
  const double strongest = scale * *std::max_element(activity.begin(), activity.end());
  if (!(strongest > 0)) return;
  // Stable to D dt / cell^2 = 1/4 in two dimensions; a fifth keeps every cell between its neighbours.
  const double steps = std::ceil(strongest * duration / (0.2 * cell * cell));
  const double gain = scale * duration / steps / (2 * cell * cell);
  for (double step = 0; step < steps; ++step) substep(frame, gain, activity, height, scratch);
}

void spread_across(const WindFrame& frame, double sigma, std::vector<double>& values,
                   std::vector<double>& scratch) {
  const std::size_t n = frame.stations();
  const std::size_t rows = frame.rows();
  if (rows < 2 || !(sigma > 0)) return;
  // Each pass is a kernel (b, 1 - 2b, b) of variance 2b. Wider than the grid is no wider than the grid.
  const double variance = std::min(sigma * sigma, static_cast<double>(rows * rows));
  const double passes = std::ceil(variance / 0.5);
  const double b = variance / passes / 2;
  const std::size_t faces = frame.periodic() ? rows : rows - 1;
  for (double pass = 0; pass < passes; ++pass) {
    scratch = values;
    for (std::size_t row = 0; row < faces; ++row) {
      const std::size_t first = row * n;
      const std::size_t other = row + 1 == rows ? 0 : first + n;
      for (std::size_t i = 0; i < n; ++i) {
        const double flow = b * (values[first + i] - values[other + i]);
        scratch[first + i] -= flow;
        scratch[other + i] += flow;
      }
    }
    values.swap(scratch);
  }
}

}  // namespace aeolian
