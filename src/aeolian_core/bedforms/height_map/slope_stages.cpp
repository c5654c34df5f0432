#include "aeolian_core/bedforms/height_map/slope_stages.hpp"

#include <algorithm>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

/// A station and what lies before and behind it.
struct Rows {
  const double* here;
  const double* before;
  const double* behind;
};

/// What flows into a cell of deep sand; a face's activity is the sum of its two cells'.
struct ByActivity {
  const double* a;
  const double* before;
  const double* behind;

  AEOLIAN_INLINE double inflow(const Rows& h, std::ptrdiff_t i) const {
    const double along =
        (a[i] + behind[i]) * (h.behind[i] - h.here[i]) - (before[i] + a[i]) * (h.here[i] - h.before[i]);
    const double across =
        (a[i] + a[i + 1]) * (h.here[i + 1] - h.here[i]) - (a[i - 1] + a[i]) * (h.here[i] - h.here[i - 1]);
    return along + across;
  }
};

/// The same by the activities of faces: behind the station here and before it, and beside each row.
struct ByFaces {
  const double* behind;
  const double* before;
  const double* beside;

  AEOLIAN_INLINE double inflow(const Rows& h, std::ptrdiff_t i) const {
    const double along = behind[i] * (h.behind[i] - h.here[i]) - before[i] * (h.here[i] - h.before[i]);
    const double across =
        beside[i] * (h.here[i + 1] - h.here[i]) - beside[i - 1] * (h.here[i] - h.here[i - 1]);
    return along + across;
  }
};

template <class Faces>
AEOLIAN_INLINE void begin_with(std::ptrdiff_t count, double gain, const Rows& height, const Faces& faces,
                               double* __restrict first, double* __restrict next) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double d = faces.inflow(height, i);
    first[i] = d;
    next[i] = height.here[i] + gain * d;
  }
}

template <class Faces>
AEOLIAN_INLINE void go_on_with(std::ptrdiff_t count, const SlopeStages::Weights& given, const Rows& height,
                               const double* before_last, const Faces& faces, const double* start,
                               const double* __restrict first, double* __restrict next) {
  const SlopeStages::Weights c = given;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double d = faces.inflow(height, i);
    next[i] = (c.last * height.here[i] + c.before_last * before_last[i] + c.start * start[i]) +
              (c.gain * d + c.first_gain * first[i]);
  }
}

AEOLIAN_WIDE_KERNEL void begin_stages(std::ptrdiff_t count, double gain, Rows height, ByActivity activity,
                                      double* first, double* next) {
  begin_with(count, gain, height, activity, first, next);
}

AEOLIAN_WIDE_KERNEL void begin_stages_by_faces(std::ptrdiff_t count, double gain, Rows height, ByFaces faces,
                                               double* first, double* next) {
  begin_with(count, gain, height, faces, first, next);
}

AEOLIAN_WIDE_KERNEL void add_stage(std::ptrdiff_t count, const SlopeStages::Weights& c, Rows height,
                                   const double* before_last, ByActivity activity, const double* start,
                                   const double* first, double* next) {
  go_on_with(count, c, height, before_last, activity, start, first, next);
}

AEOLIAN_WIDE_KERNEL void add_stage_by_faces(std::ptrdiff_t count, const SlopeStages::Weights& c, Rows height,
                                            const double* before_last, ByFaces faces, const double* start,
                                            const double* first, double* next) {
  go_on_with(count, c, height, before_last, faces, start, first, next);
}

/// Faces between deep cells.
AEOLIAN_WIDE_KERNEL void face_activities(std::ptrdiff_t count, const double* __restrict a,
                                         const double* __restrict a_behind, const double* __restrict deep,
                                         const double* __restrict deep_behind, double* __restrict behind,
                                         double* __restrict beside) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    behind[i] = (a[i] + a_behind[i]) * (deep[i] * deep_behind[i]);
    beside[i] = (a[i] + a[i + 1]) * (deep[i] * deep[i + 1]);
  }
}

int power_of_two(int least) {
  int power = 1;
  while (power < least) power *= 2;
  return power;
}

}  // namespace

SlopeStages::SlopeStages(const WindFrame& frame, int count, double gain, const FrameField& activity,
                         const FrameField* deep, const FrameField& height, FrameField& result)
    : frame_(frame),
      count_(count),
      activity_(activity),
      deep_(deep),
      height_(height),
      result_(result),
      between_(4 * (count - 1), frame.rows()),
      kept_(power_of_two(count + 2)),
      first_(kept_, frame.rows()) {
  if (deep) faces_ = FrameField(2 * kept_, frame.rows());
  const double n = count;
  const double w = 4 / (n * n + n - 2);
  const auto b = [](double j) { return j < 2 ? 1.0 / 3 : (j * j + j - 2) / (2 * j * (j + 1)); };
  begin_gain_ = w / 3 * gain;
  for (double j = 2; j <= n; ++j) {
    const double mu = (2 * j - 1) / j * b(j) / b(j - 1);
    const double nu = -(j - 1) / j * b(j) / b(j - 2);
    weights_.push_back({mu, nu, 1 - mu - nu, mu * w * gain, -(1 - b(j - 1)) * mu * w * gain});
  }
}

void SlopeStages::run(int begin, int end, int row_begin, int row_end) {
  row_begin_ = row_begin;
  row_end_ = row_end;
  for (int station = begin - count_; station < end + count_; ++station) {
    if (deep_) find_faces(station - 1);
    for (int j = 1; j <= count_; ++j) {
      const int at = station - j;
      const int beyond = count_ - j;
      if (at < begin - beyond || at >= end + beyond) continue;
      if (!frame_.periodic() && (at < 0 || at >= frame_.stations())) continue;
      run_stage(j, at);
    }
  }
}

/// The station of the field that one is or goes on as.
int SlopeStages::wrapped(int station) const {
  const int n = frame_.stations();
  if (station >= 0 && station < n) return station;
  return frame_.periodic() ? (station % n + n) % n : std::clamp(station, 0, n - 1);
}

/// Heights after stage j, 0 ... count - 1.
const double* SlopeStages::row(int j, int station) {
  if (j == 0) return height_.at(wrapped(station));
  return between_.at(4 * (j - 1) + ((frame_.periodic() ? station : wrapped(station)) & 3));
}

/// Where what is kept of the last stations lies.
int SlopeStages::turn(int station) const { return station & (kept_ - 1); }

/// From the station to the next, and from each row to the next. Walls pass nothing.
void SlopeStages::find_faces(int station) {
  const int here = wrapped(station);
  const int behind = wrapped(station + 1);
  const int begin = row_begin_ - 1;
  double* const along = faces_.at(2 * turn(station));
  face_activities(row_end_ - begin, activity_.at(here) + begin, activity_.at(behind) + begin,
                  deep_->at(here) + begin, deep_->at(behind) + begin, along + begin,
                  faces_.at(2 * turn(station) + 1) + begin);
  if (here == behind) std::fill(along + begin, along + row_end_, 0.0);
}

void SlopeStages::run_stage(int j, int at) {
  const int begin = row_begin_;
  const int count = row_end_ - row_begin_;
  const Rows height{row(j - 1, at) + begin, row(j - 1, at - 1) + begin, row(j - 1, at + 1) + begin};
  double* const first = first_.at(turn(at)) + begin;
  FrameField& to = j == count_ ? result_ : between_;
  const int place = j == count_ ? wrapped(at) : 4 * (j - 1) + (at & 3);
  double* const next = to.at(place) + begin;
  const ByActivity activity{activity_.at(wrapped(at)) + begin, activity_.at(wrapped(at - 1)) + begin,
                            activity_.at(wrapped(at + 1)) + begin};
  const auto faces = [&] {
    return ByFaces{faces_.at(2 * turn(at)) + begin, faces_.at(2 * turn(at - 1)) + begin,
                   faces_.at(2 * turn(at) + 1) + begin};
  };
  if (j == 1) {
    if (deep_)
      begin_stages_by_faces(count, begin_gain_, height, faces(), first, next);
    else
      begin_stages(count, begin_gain_, height, activity, first, next);
  } else {
    const Weights& weights = weights_[static_cast<std::size_t>(j) - 2];
    const double* const before_last = row(j - 2, at) + begin;
    const double* const start = row(0, at) + begin;
    if (deep_)
      add_stage_by_faces(count, weights, height, before_last, faces(), start, first, next);
    else
      add_stage(count, weights, height, before_last, activity, start, first, next);
  }
  to.fill_pads(place, frame_.periodic());
}

}  // namespace aeolian
