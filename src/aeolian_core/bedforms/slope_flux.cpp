#include "aeolian_core/bedforms/slope_flux.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_at_once = 16;

/// A station and what lies before and behind it.
struct Rows {
  const double* here;
  const double* before;
  const double* behind;
  Rows operator+(int row) const { return {here + row, before + row, behind + row}; }
};

/// What flows into a cell; a face's activity is the sum of its two cells'.
AEOLIAN_INLINE double divergence(const double* h, const double* h_before, const double* h_behind,
                                 const double* a, const double* a_before, const double* a_behind,
                                 std::ptrdiff_t i) {
  const double along =
      (a[i] + a_behind[i]) * (h_behind[i] - h[i]) - (a_before[i] + a[i]) * (h[i] - h_before[i]);
  const double across = (a[i] + a[i + 1]) * (h[i + 1] - h[i]) - (a[i - 1] + a[i]) * (h[i] - h[i - 1]);
  return along + across;
}

AEOLIAN_KERNEL void begin_stages(std::ptrdiff_t count, double gain, Rows height, Rows activity,
                                 double* __restrict start, double* __restrict first,
                                 double* __restrict next) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double d = divergence(height.here, height.before, height.behind, activity.here, activity.before,
                                activity.behind, i);
    start[i] = height.here[i];
    first[i] = d;
    next[i] = height.here[i] + gain * d;
  }
}

struct Stage {
  double last, before_last, start, gain, first_gain;
};

AEOLIAN_KERNEL void add_stage(std::ptrdiff_t count, const Stage& given, Rows height, Rows activity,
                              const double* __restrict start, const double* __restrict first,
                              double* __restrict next) {
  const Stage c = given;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double d = divergence(height.here, height.before, height.behind, activity.here, activity.before,
                                activity.behind, i);
    next[i] = (c.last * height.here[i] + c.before_last * next[i] + c.start * start[i]) +
              (c.gain * d + c.first_gain * first[i]);
  }
}

/// What flows into a cell from another one, at most a quarter of what lies where it comes from.
AEOLIAN_INLINE double inflow(double gain, double a, double a_other, double h, double h_other, double floor,
                             double floor_other, double open, double open_other) {
  const double raw = gain * (a + a_other) * (h_other - h);
  const double mine = -0.25 * (h - floor);
  const double others = 0.25 * (h_other - floor_other);
  const double lower = mine < 0 ? mine : 0;
  const double upper = others > 0 ? others : 0;
  const double flow = raw > lower ? raw : lower;
  return open * open_other * (flow < upper ? flow : upper);
}

AEOLIAN_KERNEL void exchange_on_ground(std::ptrdiff_t count, double gain, Rows height, Rows activity,
                                       Rows floors, Rows opens, double* __restrict next) {
  const double* const h = height.here;
  const double* const a = activity.here;
  const double* const f = floors.here;
  const double* const o = opens.here;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double along = inflow(gain, a[i], activity.behind[i], h[i], height.behind[i], f[i],
                                floors.behind[i], o[i], opens.behind[i]) +
                         inflow(gain, a[i], activity.before[i], h[i], height.before[i], f[i],
                                floors.before[i], o[i], opens.before[i]);
    const double across = inflow(gain, a[i], a[i + 1], h[i], h[i + 1], f[i], f[i + 1], o[i], o[i + 1]) +
                          inflow(gain, a[i], a[i - 1], h[i], h[i - 1], f[i], f[i - 1], o[i], o[i - 1]);
    next[i] = h[i] + (along + across);
  }
}

}  // namespace

SlopeFlux::SlopeFlux(const WindFrame& frame, double cell, double scale)
    : frame_(frame),
      cell_(cell),
      scale_(scale),
      next_(frame.stations(), frame.rows()),
      start_(next_),
      first_(next_) {}

/// Calls work(station, rows_of), in parallel; rows_of(field) are those of the station and its neighbours.
template <class Work>
void SlopeFlux::for_stations(Work&& work) const {
  const int n = frame_.stations();
  const bool periodic = frame_.periodic();
  tbb::parallel_for(0, (n + stations_at_once - 1) / stations_at_once, [&](int block) {
    for (int i = block * stations_at_once; i < std::min((block + 1) * stations_at_once, n); ++i)
      work(i, [&](const FrameField& field) {
        return Rows{field.at(i),
                    field.at(i > 0      ? i - 1
                             : periodic ? n - 1
                                        : 0),
                    field.at(i + 1 < n  ? i + 1
                             : periodic ? 0
                                        : n - 1)};
      });
  });
}

void SlopeFlux::run(const FrameField& activity, double strongest_activity, double duration,
                    FrameField& height) {
  const double strongest = scale_ * strongest_activity;
  if (!(strongest > 0)) return;
  // One explicit step is stable to D dt / cell^2 = 1/4 in two dimensions. A Runge-Kutta-Legendre scheme of
  // second order and n stages covers (n^2 + n - 2) / 4 of them (Meyer, Balsara and Aslam 2014).
  const double explicit_steps = strongest * duration / (0.25 * cell_ * cell_);
  const double stages = std::max(2.0, std::ceil(std::sqrt(2.25 + 4 * explicit_steps) - 0.5));
  // A face's activity is the sum of two, hence a half.
  const double gain = scale_ * duration / (2 * cell_ * cell_);
  const double w = 4 / (stages * stages + stages - 2);
  const auto b = [](double j) { return j < 2 ? 1.0 / 3 : (j * j + j - 2) / (2 * j * (j + 1)); };
  const int rows = frame_.rows();
  const bool periodic = frame_.periodic();

  for_stations([&](int i, auto&& rows_of) {
    begin_stages(rows, w / 3 * gain, rows_of(height), rows_of(activity), start_.at(i), first_.at(i),
                 next_.at(i));
    next_.fill_pads(i, periodic);
  });
  height.swap(next_);
  for (double j = 2; j <= stages; ++j) {
    const double mu = (2 * j - 1) / j * b(j) / b(j - 1);
    const double nu = -(j - 1) / j * b(j) / b(j - 2);
    const Stage stage{mu, nu, 1 - mu - nu, mu * w * gain, -(1 - b(j - 1)) * mu * w * gain};
    for_stations([&](int i, auto&& rows_of) {
      add_stage(rows, stage, rows_of(height), rows_of(activity), start_.at(i), first_.at(i), next_.at(i));
      next_.fill_pads(i, periodic);
    });
    height.swap(next_);
  }
}

void SlopeFlux::run(const FrameField& activity, double strongest_activity, double duration,
                    const HardGround& ground, const ActivePatches& active, FrameField& height) {
  const double strongest = scale_ * strongest_activity;
  if (!(strongest > 0)) return;
  // A fifth keeps every cell between its neighbours.
  const double steps = std::ceil(strongest * duration / (0.2 * cell_ * cell_));
  const double gain = scale_ * duration / steps / (2 * cell_ * cell_);
  for (double step = 0; step < steps; ++step) {
    for_stations([&](int i, auto&& rows_of) {
      active.for_runs(i, [&](int begin, int end) {
        exchange_on_ground(end - begin, gain, rows_of(height) + begin, rows_of(activity) + begin,
                           rows_of(ground.floor) + begin, rows_of(ground.open) + begin, next_.at(i) + begin);
      });
    });
    for_stations([&](int i, auto&&) {
      active.for_runs(i, [&](int begin, int end) {
        std::copy(next_.at(i) + begin, next_.at(i) + end, height.at(i) + begin);
        height.fill_pads(i, frame_.periodic());
      });
    });
  }
}

}  // namespace aeolian
