#include "aeolian_core/bedforms/slope_flux.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_at_once = 16;

/// One stage at one station between two others: new = a h + (1 - a) new + flux. A face's activity is the mean
/// of its two cells'.
AEOLIAN_KERNEL void exchange(std::ptrdiff_t count, double now, double gain, const double* __restrict h,
                             const double* __restrict h_before, const double* __restrict h_behind,
                             const double* __restrict a, const double* __restrict a_before,
                             const double* __restrict a_behind, double* __restrict next) {
  const double earlier = 1 - now;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double along = (a[i] + a_behind[i]) * (h_behind[i] - h[i]) - (a_before[i] + a[i]) * (h[i] - h_before[i]);
    const double across = (a[i] + a[i + 1]) * (h[i + 1] - h[i]) - (a[i - 1] + a[i]) * (h[i] - h[i - 1]);
    next[i] = now * h[i] + earlier * next[i] + gain * (along + across);
  }
}

}  // namespace

void apply_slope_flux(const WindFrame& frame, double cell, double scale, const FrameField& activity,
                      double strongest_activity, double duration, FrameField& height, FrameField& scratch) {
  const double strongest = scale * strongest_activity;
  if (!(strongest > 0)) return;
  // One explicit step is stable to D dt / cell^2 = 1/4 in two dimensions; a fifth keeps every cell between its
  // neighbours. A Runge-Kutta-Legendre scheme of n stages covers (n^2 + n) / 2 such steps (Meyer, Balsara and
  // Aslam 2012).
  const double explicit_steps = strongest * duration / (0.2 * cell * cell);
  const double stages = std::max(1.0, std::ceil(std::sqrt(0.25 + 2 * explicit_steps) - 0.5));
  // A face's activity is the sum of two, hence a half.
  const double gain = scale * duration / (2 * cell * cell) * 2 / (stages * stages + stages);
  const int n = frame.stations();
  const bool periodic = frame.periodic();
  for (double stage = 1; stage <= stages; ++stage) {
    const double now = (2 * stage - 1) / stage;
    tbb::parallel_for(0, (n + stations_at_once - 1) / stations_at_once, [&](int block) {
      for (int i = block * stations_at_once; i < std::min((block + 1) * stations_at_once, n); ++i) {
        const int before = i > 0 ? i - 1 : periodic ? n - 1 : 0;
        const int behind = i + 1 < n ? i + 1 : periodic ? 0 : n - 1;
        exchange(frame.rows(), now, now * gain, height.at(i), height.at(before), height.at(behind), activity.at(i),
                 activity.at(before), activity.at(behind), scratch.at(i));
        scratch.fill_pads(i, periodic);
      }
    });
    height.swap(scratch);
  }
}

}  // namespace aeolian
