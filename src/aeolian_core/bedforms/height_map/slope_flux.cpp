#include "aeolian_core/bedforms/height_map/slope_flux.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/height_map/slope_stages.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_together = 64;  ///< whose stages follow one another
constexpr int stations_at_once = 16;

/// Of a flat bed's: of less, thin sand on hard ground does not flow down slopes.
constexpr double least_activity = 1e-2;

/// A station and what lies before and behind it.
struct Rows {
  const double* here;
  const double* before;
  const double* behind;
};

/// Marks what is open and deeper than `least`.
AEOLIAN_WIDE_KERNEL void mark_deep(std::ptrdiff_t count, double least, const double* __restrict h,
                                   const double* __restrict floor, const double* __restrict open,
                                   double* __restrict deep) {
  for (std::ptrdiff_t i = 0; i < count; ++i) deep[i] = (h[i] - floor[i]) * open[i] > least ? 1 : 0;
}

/// Explicit steps of thin sand in one step of the model: more than that, and it is level over several cells
/// anyway.
constexpr double most_steps = 32;

/// What thin faces are told by; none counts as stronger than `most`.
struct Thin {
  Rows activity, open, deep;
  double most;
};

/// Twice the activity of a face between a cell and another one, zero unless that is open, not between two
/// deep cells and strong enough.
AEOLIAN_INLINE double thin_face(double a, double a_other, double open, double open_other, double deep,
                                double deep_other, double most) {
  const double sum = (a + a_other) * (open * open_other * (1 - deep * deep_other));
  const double capped = sum < 2 * most ? sum : 2 * most;
  return sum > 2 * least_activity ? capped : 0;
}

/// Those around a cell.
struct ThinFaces {
  double behind, before, above, below;
};
AEOLIAN_INLINE ThinFaces thin_faces(const Thin& t, std::ptrdiff_t i) {
  const double* const a = t.activity.here;
  const double* const o = t.open.here;
  const double* const d = t.deep.here;
  return {thin_face(a[i], t.activity.behind[i], o[i], t.open.behind[i], d[i], t.deep.behind[i], t.most),
          thin_face(a[i], t.activity.before[i], o[i], t.open.before[i], d[i], t.deep.before[i], t.most),
          thin_face(a[i], a[i + 1], o[i], o[i + 1], d[i], d[i + 1], t.most),
          thin_face(a[i], a[i - 1], o[i], o[i - 1], d[i], d[i - 1], t.most)};
}

/// The strongest mean activity of the faces around a cell, of which only the thin ones count.
AEOLIAN_WIDE_KERNEL double strongest_thin(std::ptrdiff_t count, Thin thin) {
  double lanes[8] = {};
  for (std::ptrdiff_t begin = 0; begin < count; begin += 8)
    for (std::ptrdiff_t i = begin; i < std::min(begin + 8, count); ++i) {
      const ThinFaces faces = thin_faces(thin, i);
      const double sum = (faces.behind + faces.before) + (faces.above + faces.below);
      lanes[i - begin] = sum > lanes[i - begin] ? sum : lanes[i - begin];
    }
  return *std::max_element(lanes, lanes + 8) / 8;
}

/// What flows through a face into a cell from another one, at most a quarter of what lies where it comes
/// from.
AEOLIAN_INLINE double inflow(double gain, double face, double h, double h_other, double floor,
                             double floor_other) {
  const double raw = gain * face * (h_other - h);
  const double mine = -0.25 * (h - floor);
  const double others = 0.25 * (h_other - floor_other);
  const double lower = mine < 0 ? mine : 0;
  const double upper = others > 0 ? others : 0;
  const double flow = raw > lower ? raw : lower;
  return face > 0 ? (flow < upper ? flow : upper) : 0;
}

AEOLIAN_WIDE_KERNEL void exchange_on_ground(std::ptrdiff_t count, double gain, Rows height, Rows floors,
                                            Thin thin, double* __restrict next) {
  const double* const h = height.here;
  const double* const f = floors.here;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const ThinFaces faces = thin_faces(thin, i);
    const double along = inflow(gain, faces.behind, h[i], height.behind[i], f[i], floors.behind[i]) +
                         inflow(gain, faces.before, h[i], height.before[i], f[i], floors.before[i]);
    const double across = inflow(gain, faces.above, h[i], h[i + 1], f[i], f[i + 1]) +
                          inflow(gain, faces.below, h[i], h[i - 1], f[i], f[i - 1]);
    next[i] = h[i] + (along + across);
  }
}

/// Whether any deep cell has been taken below its floor.
AEOLIAN_WIDE_KERNEL bool any_below(std::ptrdiff_t count, const double* __restrict next,
                                   const double* __restrict floor, const double* __restrict deep) {
  std::int64_t any = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) any |= (next[i] < floor[i]) & (deep[i] > 0);
  return any != 0;
}

AEOLIAN_WIDE_KERNEL void take_deep(std::ptrdiff_t count, const double* __restrict next,
                                   const double* __restrict deep, double* __restrict height) {
  for (std::ptrdiff_t i = 0; i < count; ++i) height[i] = deep[i] > 0 ? next[i] : height[i];
}

}  // namespace

SlopeFlux::SlopeFlux(const WindFrame& frame, double cell, double scale)
    : frame_(frame), cell_(cell), scale_(scale), next_(FrameField::unset(frame.stations(), frame.rows())) {}

/// Calls work(begin, end) for blocks of stations, in parallel.
template <class Work>
void SlopeFlux::for_blocks(int each, Work&& work) const {
  const int n = frame_.stations();
  tbb::parallel_for(0, (n + each - 1) / each,
                    [&](int block) { work(block * each, std::min((block + 1) * each, n)); });
}

/// Calls work(station, begin, end, rows_of) for the runs of active rows, in parallel; rows_of(field) are
/// those of the station and its neighbours from a row on.
template <class Work>
void SlopeFlux::for_active(const ActivePatches& active, Work&& work) const {
  const int n = frame_.stations();
  const bool periodic = frame_.periodic();
  for_blocks(stations_at_once, [&](int first, int last) {
    for (int i = first; i < last; ++i)
      active.for_runs(i, [&](int begin, int end) {
        const int before = i > 0 ? i - 1 : periodic ? n - 1 : 0;
        const int behind = i + 1 < n ? i + 1 : periodic ? 0 : n - 1;
        work(i, begin, end, [&](const FrameField& field, int row) {
          return Rows{field.at(i) + row, field.at(before) + row, field.at(behind) + row};
        });
      });
  });
}

/// Of a Runge-Kutta-Legendre scheme. One explicit step is stable to D dt / cell^2 = 1/4 in two dimensions; n
/// stages cover (n^2 + n - 2) / 4 of them.
int SlopeFlux::stages(double strongest_activity, double duration) const {
  const double explicit_steps = scale_ * strongest_activity * duration / (0.25 * cell_ * cell_);
  return static_cast<int>(std::max(2.0, std::ceil(std::sqrt(2.25 + 4 * explicit_steps) - 0.5)));
}

/// Weight of a difference of heights. A face's activity is the sum of two, hence a half.
double SlopeFlux::gain(double duration) const { return scale_ * duration / (2 * cell_ * cell_); }

void SlopeFlux::run(const FrameField& activity, double strongest_activity, double duration,
                    FrameField& height) {
  if (!(scale_ * strongest_activity > 0)) return;
  const int count = stages(strongest_activity, duration);
  for_blocks(std::max(stations_together, 4 * count), [&](int begin, int end) {
    SlopeStages(frame_, count, gain(duration), activity, nullptr, height, next_)
        .run(begin, end, 0, frame_.rows());
  });
  height.swap(next_);
}

void SlopeFlux::run(const FrameField& activity, double strongest_activity, double duration,
                    const HardGround& ground, const ActivePatches& active, FrameField& height) {
  if (!(scale_ * strongest_activity > 0)) return;
  find_deep(ground, active, height);
  run_deep(activity, strongest_activity, duration, ground, active, height);
  run_thin(activity, duration, ground, active, height);
}

/// Sand of more than a quarter of a cell's depth is deep.
void SlopeFlux::find_deep(const HardGround& ground, const ActivePatches& active, const FrameField& height) {
  if (deep_.rows() == 0) deep_ = FrameField(frame_.stations(), frame_.rows());
  const auto set = [&](const ActivePatches& patches, auto&& set_run) {
    for_blocks(stations_at_once, [&](int first, int last) {
      for (int i = first; i < last; ++i) {
        bool any = false;
        patches.for_runs(i, [&](int begin, int end) {
          set_run(i, begin, end);
          any = true;
        });
        if (any) deep_.fill_pads(i, frame_.periodic());
      }
    });
  };
  if (was_active_)
    set(*was_active_,
        [&](int i, int begin, int end) { std::fill(deep_.at(i) + begin, deep_.at(i) + end, 0.0); });
  was_active_ = active;
  set(active, [&](int i, int begin, int end) {
    mark_deep(end - begin, 0.25 * cell_, height.at(i) + begin, ground.floor.at(i) + begin,
              ground.open.at(i) + begin, deep_.at(i) + begin);
  });
}

/// Among deep cells sand flows as if there were no floor. Should one come to light, nothing does, and no cell
/// is deep any more.
void SlopeFlux::run_deep(const FrameField& activity, double strongest_activity, double duration,
                         const HardGround& ground, const ActivePatches& active, FrameField& height) {
  const int count = stages(strongest_activity, duration);
  std::atomic<bool> below{false};
  for_blocks(std::max(stations_together, 4 * count), [&](int begin, int end) {
    int first = frame_.rows();
    int last = 0;
    const int n = frame_.stations();
    for (int i = begin - count; i < end + count; ++i) {
      if (!frame_.periodic() && (i < 0 || i >= n)) continue;
      active.for_runs((i % n + n) % n, [&](int from, int to) {
        first = std::min(first, from);
        last = std::max(last, to);
      });
    }
    if (first >= last) return;
    SlopeStages(frame_, count, gain(duration), activity, &deep_, height, next_).run(begin, end, first, last);
    for (int i = begin; i < end; ++i)
      if (any_below(last - first, next_.at(i) + first, ground.floor.at(i) + first, deep_.at(i) + first))
        below = true;
  });
  for_active(active, [&](int i, int begin, int end, auto&&) {
    if (below)
      std::fill(deep_.at(i) + begin, deep_.at(i) + end, 0.0);
    else
      take_deep(end - begin, next_.at(i) + begin, deep_.at(i) + begin, height.at(i) + begin);
  });
  for (int i = 0; i < frame_.stations(); ++i) {
    height.fill_pads(i, frame_.periodic());
    deep_.fill_pads(i, frame_.periodic());
  }
}

/// Through the other faces it flows by explicit steps and no more of it than there is.
void SlopeFlux::run_thin(const FrameField& activity, double duration, const HardGround& ground,
                         const ActivePatches& active, FrameField& height) {
  // A fifth keeps every cell between its neighbours.
  const double per_step = 0.2 * cell_ * cell_;
  const double cap = most_steps * per_step / (scale_ * duration);
  ActivePatches thin = active;
  std::vector<double> strongest(static_cast<std::size_t>(frame_.stations()), 0.0);
  for_active(active, [&](int i, int begin, int end, auto&& rows_of) {
    for (int row = begin; row < end; row += ActivePatches::rows_each) {
      const int count = std::min(ActivePatches::rows_each, end - row);
      const double most = strongest_thin(
          count, {rows_of(activity, row), rows_of(ground.open, row), rows_of(deep_, row), cap});
      thin.set(i, row / ActivePatches::rows_each, most > 0);
      strongest[static_cast<std::size_t>(i)] = std::max(strongest[static_cast<std::size_t>(i)], most);
    }
  });
  const double most = *std::max_element(strongest.begin(), strongest.end());
  if (!(most > 0)) return;
  const double steps = std::ceil(scale_ * most * duration / per_step);
  for (double step = 0; step < steps; ++step) {
    for_active(thin, [&](int i, int begin, int end, auto&& rows_of) {
      exchange_on_ground(end - begin, gain(duration / steps), rows_of(height, begin),
                         rows_of(ground.floor, begin),
                         {rows_of(activity, begin), rows_of(ground.open, begin), rows_of(deep_, begin), cap},
                         next_.at(i) + begin);
    });
    for_active(thin, [&](int i, int begin, int end, auto&&) {
      std::copy(next_.at(i) + begin, next_.at(i) + end, height.at(i) + begin);
      height.fill_pads(i, frame_.periodic());
    });
  }
}

}  // namespace aeolian
