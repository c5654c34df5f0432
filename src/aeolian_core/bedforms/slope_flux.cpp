#include "aeolian_core/bedforms/slope_flux.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_at_once = 16;
constexpr int stations_together = 64;  ///< whose stages follow one another

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
                                 double* __restrict first, double* __restrict next) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double d = divergence(height.here, height.before, height.behind, activity.here, activity.before,
                                activity.behind, i);
    first[i] = d;
    next[i] = height.here[i] + gain * d;
  }
}

struct Stage {
  double last, before_last, start, gain, first_gain;
};

AEOLIAN_KERNEL void add_stage(std::ptrdiff_t count, const Stage& given, Rows height,
                              const double* before_last, Rows activity, const double* start,
                              const double* __restrict first, double* __restrict next) {
  const Stage c = given;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double d = divergence(height.here, height.before, height.behind, activity.here, activity.before,
                                activity.behind, i);
    next[i] = (c.last * height.here[i] + c.before_last * before_last[i] + c.start * start[i]) +
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
    : frame_(frame), cell_(cell), scale_(scale), next_(frame.stations(), frame.rows()) {}

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

/// The stages of a Runge-Kutta-Legendre step on a stretch of stations, each one station behind the one
/// before it, so that a bed is read and written once and what lies in between stays in a cache. A stage is
/// worked out as far beyond the stretch as the later ones look.
class SlopeFlux::Stages {
 public:
  Stages(const SlopeFlux& flux, int count, double gain, const FrameField& activity, const FrameField& height,
         FrameField& result)
      : frame_(flux.frame_),
        count_(count),
        activity_(activity),
        height_(height),
        result_(result),
        between_(4 * (count - 1), frame_.rows()),
        first_(count + 2, frame_.rows()) {
    const double n = count;
    const double w = 4 / (n * n + n - 2);
    const auto b = [](double j) { return j < 2 ? 1.0 / 3 : (j * j + j - 2) / (2 * j * (j + 1)); };
    first_gain_ = w / 3 * gain;
    for (double j = 2; j <= n; ++j) {
      const double mu = (2 * j - 1) / j * b(j) / b(j - 1);
      const double nu = -(j - 1) / j * b(j) / b(j - 2);
      stages_.push_back({mu, nu, 1 - mu - nu, mu * w * gain, -(1 - b(j - 1)) * mu * w * gain});
    }
  }

  void run(int begin, int end) {
    for (int station = begin - count_; station < end + count_; ++station)
      for (int j = 1; j <= count_; ++j) {
        const int at = station - j;
        const int beyond = count_ - j;
        if (at < begin - beyond || at >= end + beyond) continue;
        if (!frame_.periodic() && (at < 0 || at >= frame_.stations())) continue;
        run_stage(j, at);
      }
  }

 private:
  /// The station of the field that one is or goes on as.
  int wrapped(int station) const {
    const int n = frame_.stations();
    return frame_.periodic() ? (station % n + n) % n : std::clamp(station, 0, n - 1);
  }
  /// Heights after stage j, 0 ... count - 1.
  const double* row(int j, int station) {
    if (j == 0) return height_.at(wrapped(station));
    return between(j, frame_.periodic() ? station : wrapped(station));
  }
  double* between(int j, int station) { return between_.at(4 * (j - 1) + (station & 3)); }

  void run_stage(int j, int at) {
    const Rows height{row(j - 1, at), row(j - 1, at - 1), row(j - 1, at + 1)};
    const Rows activity{activity_.at(wrapped(at)), activity_.at(wrapped(at - 1)),
                        activity_.at(wrapped(at + 1))};
    const int turn = count_ + 2;
    double* const first = first_.at((at % turn + turn) % turn);
    FrameField& to = j == count_ ? result_ : between_;
    const int place = j == count_ ? wrapped(at) : 4 * (j - 1) + (at & 3);
    if (j == 1)
      begin_stages(frame_.rows(), first_gain_, height, activity, first, to.at(place));
    else
      add_stage(frame_.rows(), stages_[static_cast<std::size_t>(j) - 2], height, row(j - 2, at), activity,
                row(0, at), first, to.at(place));
    to.fill_pads(place, frame_.periodic());
  }

  const WindFrame& frame_;
  int count_;
  const FrameField& activity_;
  const FrameField& height_;
  FrameField& result_;
  FrameField between_;  ///< four stations of each stage in turn
  FrameField first_;    ///< what flows at first
  double first_gain_ = 0;
  std::vector<Stage> stages_;
};

void SlopeFlux::run(const FrameField& activity, double strongest_activity, double duration,
                    FrameField& height) {
  const double strongest = scale_ * strongest_activity;
  if (!(strongest > 0)) return;
  // One explicit step is stable to D dt / cell^2 = 1/4 in two dimensions. A Runge-Kutta-Legendre scheme of
  // second order and n stages covers (n^2 + n - 2) / 4 of them (Meyer, Balsara and Aslam 2014).
  const double explicit_steps = strongest * duration / (0.25 * cell_ * cell_);
  const int stages = static_cast<int>(std::max(2.0, std::ceil(std::sqrt(2.25 + 4 * explicit_steps) - 0.5)));
  // A face's activity is the sum of two, hence a half.
  const double gain = scale_ * duration / (2 * cell_ * cell_);
  const int n = frame_.stations();
  const int each = std::max(stations_together, 4 * stages);
  tbb::parallel_for(0, (n + each - 1) / each, [&](int block) {
    Stages(*this, stages, gain, activity, height, next_).run(block * each, std::min((block + 1) * each, n));
  });
  height.swap(next_);
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
