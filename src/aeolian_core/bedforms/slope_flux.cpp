#include "aeolian_core/bedforms/slope_flux.hpp"

#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_at_once = 16;

/// One explicit step of one station between two others; a face's activity is the mean of its two cells'.
AEOLIAN_KERNEL void exchange(std::ptrdiff_t count, double gain, const double* __restrict h,
                             const double* __restrict h_before, const double* __restrict h_behind,
                             const double* __restrict a, const double* __restrict a_before,
                             const double* __restrict a_behind, double* __restrict next) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double along = (a[i] + a_behind[i]) * (h_behind[i] - h[i]) - (a_before[i] + a[i]) * (h[i] - h_before[i]);
    const double across = (a[i] + a[i + 1]) * (h[i + 1] - h[i]) - (a[i - 1] + a[i]) * (h[i] - h[i - 1]);
    next[i] = h[i] + gain * (along + across);
  }
}

}  // namespace

void apply_slope_flux(const WindFrame& frame, double cell, double scale, const FrameField& activity,
                      double strongest_activity, double duration, FrameField& height, FrameField& scratch) {
  const double strongest = scale * strongest_activity;
  if (!(strongest > 0)) return;
  // Stable to D dt / cell^2 = 1/4 in two dimensions; a fifth keeps every cell between its neighbours.
  const double steps = std::ceil(strongest * duration / (0.2 * cell * cell));
  // A face's activity is the sum of two, hence the half.
  const double gain = scale * duration / steps / (2 * cell * cell);
  const int n = frame.stations();
  const bool periodic = frame.periodic();
  for (double step = 0; step < steps; ++step) {
    tbb::parallel_for(0, (n + stations_at_once - 1) / stations_at_once, [&](int block) {
      for (int i = block * stations_at_once; i < std::min((block + 1) * stations_at_once, n); ++i) {
        const int before = i > 0 ? i - 1 : periodic ? n - 1 : 0;
        const int behind = i + 1 < n ? i + 1 : periodic ? 0 : n - 1;
        exchange(frame.rows(), gain, height.at(i), height.at(before), height.at(behind), activity.at(i),
                 activity.at(before), activity.at(behind), scratch.at(i));
        scratch.fill_pads(i, periodic);
      }
    });
    height.swap(scratch);
  }
}

}  // namespace aeolian
