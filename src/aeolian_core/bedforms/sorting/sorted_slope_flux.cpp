#include "aeolian_core/bedforms/sorting/sorted_slope_flux.hpp"

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
};

/// What flows into a cell; a face's activity is the sum of its two cells'.
AEOLIAN_INLINE double divergence(const Rows& h, const Rows& a, std::ptrdiff_t i) {
  const double along = (a.here[i] + a.behind[i]) * (h.behind[i] - h.here[i]) -
                       (a.before[i] + a.here[i]) * (h.here[i] - h.before[i]);
  const double across = (a.here[i] + a.here[i + 1]) * (h.here[i + 1] - h.here[i]) -
                        (a.here[i - 1] + a.here[i]) * (h.here[i] - h.here[i - 1]);
  return along + across;
}

/// Weights of a stage: of the last one, the one before it, the start, and the last one's divergence.
struct Stage {
  double last, before_last, start, gain;
};

AEOLIAN_KERNEL void first_stage(std::ptrdiff_t count, const Stage& given, Rows start, Rows activity,
                                double* __restrict next) {
  const Stage c = given;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    next[i] = c.start * start.here[i] + c.gain * divergence(start, activity, i);
}

AEOLIAN_KERNEL void add_stage(std::ptrdiff_t count, const Stage& given, Rows last, Rows activity,
                              const double* __restrict start, double* __restrict next) {
  const Stage c = given;
  for (std::ptrdiff_t i = 0; i < count; ++i)
    next[i] = (c.last * last.here[i] + c.before_last * next[i]) +
              (c.start * start[i] + c.gain * divergence(last, activity, i));
}

/// What flows into a cell from another, and the coarse part of it; `given` adds up what flows out.
AEOLIAN_INLINE double inflow(double activity, double difference, double fraction, double fraction_there,
                             double& coarse, double& given) {
  const double flow = activity * difference;
  coarse += flow * (flow > 0 ? fraction_there : fraction);
  given += flow < 0 ? -flow : 0;
  return flow;
}

/// Counts cells that give more than their layer holds.
AEOLIAN_KERNEL std::int64_t exchange(std::ptrdiff_t count, double gain, Rows z, Rows a, Rows f,
                                     const double* __restrict thickness, double* __restrict change,
                                     double* __restrict coarse_change) {
  std::int64_t beyond = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    double coarse = 0;
    double given = 0;
    const double along =
        inflow(a.here[i] + a.behind[i], z.behind[i] - z.here[i], f.here[i], f.behind[i], coarse, given) +
        inflow(a.before[i] + a.here[i], z.before[i] - z.here[i], f.here[i], f.before[i], coarse, given);
    const double across =
        inflow(a.here[i] + a.here[i + 1], z.here[i + 1] - z.here[i], f.here[i], f.here[i + 1], coarse,
               given) +
        inflow(a.here[i - 1] + a.here[i], z.here[i - 1] - z.here[i], f.here[i], f.here[i - 1], coarse, given);
    change[i] = gain * (along + across);
    coarse_change[i] = gain * coarse;
    beyond += gain * given > thickness[i] ? 1 : 0;
  }
  return beyond;
}

AEOLIAN_KERNEL void apply(std::ptrdiff_t count, const double* __restrict change,
                          const double* __restrict coarse_change, double* __restrict height,
                          double* __restrict thickness, double* __restrict coarse,
                          double* __restrict fraction) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    height[i] += change[i];
    thickness[i] += change[i];
    coarse[i] += coarse_change[i];
    fraction[i] = coarse_part(coarse[i], thickness[i]);
  }
}

}  // namespace

SortedSlopeFlux::SortedSlopeFlux(const WindFrame& frame, double cell, double scale)
    : frame_(frame),
      cell_(cell),
      scale_(scale),
      first_(frame.stations(), frame.rows()),
      second_(first_),
      change_(first_),
      coarse_change_(first_) {}

/// Calls work(station, rows_of), in parallel; rows_of(field) are those of the station and its neighbours.
template <class Work>
void SortedSlopeFlux::for_stations(Work&& work) const {
  const int n = frame_.stations();
  const bool periodic = frame_.periodic();
  tbb::parallel_for(0, (n + stations_at_once - 1) / stations_at_once, [&](int block) {
    for (int i = block * stations_at_once; i < std::min((block + 1) * stations_at_once, n); ++i)
      work(i, [&](const FrameField& field) {
        const int before = i > 0 ? i - 1 : periodic ? n - 1 : 0;
        const int behind = i + 1 < n ? i + 1 : periodic ? 0 : n - 1;
        return Rows{field.at(i), field.at(before), field.at(behind)};
      });
  });
}

/// The heights z whose divergence is what a scheme of so many stages does to the bed (Meyer, Balsara and
/// Aslam 2014, second order).
const FrameField& SortedSlopeFlux::mean_heights(const FrameField& activity, double stages, double gain,
                                                const FrameField& height) {
  const double w = 4 / (stages * stages + stages - 2);
  const auto b = [](double j) { return j < 2 ? 1.0 / 3 : (j * j + j - 2) / (2 * j * (j + 1)); };
  FrameField* last = &first_;
  FrameField* next = &second_;
  for (double j = 2; j <= stages; ++j) {
    const double mu = (2 * j - 1) / j * b(j) / b(j - 1);
    const double nu = -(j - 1) / j * b(j) / b(j - 2);
    Stage stage{mu, nu, mu * w * b(j - 1), mu * w * gain};
    // The first stage's z is w / 3 of the heights.
    if (j == 2) stage = {0, 0, stage.start + mu * w / 3, stage.gain * w / 3};
    if (j == 3) stage = {stage.last, 0, stage.start + nu * w / 3, stage.gain};
    for_stations([&](int i, auto&& rows_of) {
      if (j == 2)
        first_stage(frame_.rows(), stage, rows_of(height), rows_of(activity), next->at(i));
      else
        add_stage(frame_.rows(), stage, rows_of(*last), rows_of(activity), height.at(i), next->at(i));
      next->fill_pads(i, frame_.periodic());
    });
    std::swap(last, next);
  }
  return *last;
}

void SortedSlopeFlux::run(const FrameField& activity, double strongest_activity, double duration,
                          FrameField& height, ActiveLayer& layer) {
  const double strongest = scale_ * strongest_activity;
  if (!(strongest > 0)) return;
  const double explicit_steps = strongest * duration / (0.25 * cell_ * cell_);
  const double stages = std::max(2.0, std::ceil(std::sqrt(2.25 + 4 * explicit_steps) - 0.5));
  // A face's activity is the sum of two, hence a half.
  const double gain = scale_ * duration / (2 * cell_ * cell_);
  const FrameField& z = mean_heights(activity, stages, gain, height);

  const int rows = frame_.rows();
  std::vector<std::int64_t> beyond(static_cast<std::size_t>(frame_.stations()));
  const auto find_changes = [&] {
    for_stations([&](int i, auto&& rows_of) {
      beyond[static_cast<std::size_t>(i)] =
          exchange(rows, gain, rows_of(z), rows_of(activity), rows_of(layer.fraction()),
                   layer.thickness().at(i), change_.at(i), coarse_change_.at(i));
    });
    return std::any_of(beyond.begin(), beyond.end(), [](std::int64_t n) { return n > 0; });
  };
  if (find_changes()) {
    // Cliffs: deeper layers take part where more flows than one holds.
    for_stations([&](int i, auto&& rows_of) {
      if (beyond[static_cast<std::size_t>(i)] == 0) return;
      const Rows h = rows_of(z);
      const Rows a = rows_of(activity);
      for (int row = 0; row < rows; ++row) {
        const auto flow = [&](double there, double activity_there) {
          return std::max(0.0, gain * (a.here[row] + activity_there) * (h.here[row] - there));
        };
        layer.dig(i, row,
                  flow(h.before[row], a.before[row]) + flow(h.behind[row], a.behind[row]) +
                      flow(h.here[row - 1], a.here[row - 1]) + flow(h.here[row + 1], a.here[row + 1]));
      }
      layer.mix(i);
    });
    find_changes();
  }
  for_stations([&](int i, auto&&) {
    apply(rows, change_.at(i), coarse_change_.at(i), height.at(i), layer.thickness().at(i),
          layer.coarse().at(i), layer.fraction().at(i));
    height.fill_pads(i, frame_.periodic());
    layer.fraction().fill_pads(i, frame_.periodic());
  });
}

}  // namespace aeolian
