#include "aeolian_core/bedforms/height_map/long_wave_flux.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int means = 5;  ///< running means that make a Gaussian; fewer let short waves through
constexpr int rows_at_once = 64;
constexpr double most_decay = 0.5;  ///< of any wave in one application

AEOLIAN_WIDE_KERNEL void above(std::ptrdiff_t count, const double* __restrict bed,
                               const double* __restrict dune, double* __restrict height) {
  for (std::ptrdiff_t i = 0; i < count; ++i) height[i] = bed[i] - dune[i];
}

AEOLIAN_WIDE_KERNEL void slide(std::ptrdiff_t count, const double* __restrict enters,
                               const double* __restrict leaves, double* __restrict sum) {
  for (std::ptrdiff_t i = 0; i < count; ++i) sum[i] += enters[i] - leaves[i];
}

AEOLIAN_WIDE_KERNEL void scaled(std::ptrdiff_t count, double factor, const double* __restrict sum,
                                double* __restrict mean) {
  for (std::ptrdiff_t i = 0; i < count; ++i) mean[i] = factor * sum[i];
}

AEOLIAN_WIDE_KERNEL void exchange(std::ptrdiff_t count, double gain, const double* __restrict here,
                                  const double* __restrict other, double* __restrict flow) {
  for (std::ptrdiff_t i = 0; i < count; ++i) flow[i] = gain * (here[i] - other[i]);
}

/// Of a flow out of a cell, at most a quarter of what lies there; the flow back is bound by the other cell.
AEOLIAN_WIDE_KERNEL void limit(std::ptrdiff_t count, const double* __restrict bed,
                               const double* __restrict floor, const double* __restrict open,
                               const double* __restrict other_bed, const double* __restrict other_floor,
                               const double* __restrict other_open, double* __restrict flow) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double mine = 0.25 * (bed[i] - floor[i]);
    const double others = -0.25 * (other_bed[i] - other_floor[i]);
    const double most = mine > 0 ? mine : 0;
    const double least = others < 0 ? others : 0;
    const double capped = flow[i] < most ? flow[i] : most;
    flow[i] = open[i] * other_open[i] * (capped > least ? capped : least);
  }
}

/// Half the width of the running means that together smooth with a standard deviation, all in cells.
double half_width(double deviation) { return (std::sqrt(12.0 / means * deviation * deviation + 1) - 1) / 2; }

int half_width(double deviation, int cells, bool periodic) {
  const double most = periodic ? (cells - 1) / 2 : cells;
  return static_cast<int>(std::lround(std::min(half_width(deviation), most)));
}

}  // namespace

LongWaveFlux::LongWaveFlux(const WindFrame& frame, double cell, double wavelength, double diffusivity)
    : frame_(frame),
      cell_(cell),
      diffusivity_(diffusivity),
      half_along_(half_width(wavelength / M_PI / cell, frame.stations(), frame.periodic())),
      half_across_(half_width(wavelength / M_PI / cell, frame.rows(), frame.periodic())),
      smooth_(frame.stations(), frame.rows()),
      sums_(smooth_) {
  const double of_smooth = 2 * diffusivity * M_PI * M_PI / (wavelength * wavelength) / M_E;
  const double of_cells = 8 * diffusivity / (cell * cell);
  rate_ = std::min(of_smooth, of_cells);
}

int LongWaveFlux::reach(double wavelength, double cell) {
  return means * static_cast<int>(std::ceil(std::min(half_width(wavelength / M_PI / cell), 1e6)));
}

void LongWaveFlux::smooth_across() {
  const int n = frame_.rows();
  const int half = half_across_;
  const bool periodic = frame_.periodic();
  tbb::parallel_for(0, frame_.stations(), [&](int station) {
    double* const row = smooth_.at(station);
    double* const sums = sums_.at(station);
    for (int pass = 0; pass < means; ++pass) {
      std::copy(row, row + n, sums);
      double sum = 0;
      for (int i = -half; i <= half; ++i)
        if (periodic || (i >= 0 && i < n)) sum += sums[wrapped(i, n)];
      for (int i = 0; i < n; ++i) {
        const int count = periodic ? 2 * half + 1 : std::min(i + half, n - 1) - std::max(i - half, 0) + 1;
        row[i] = sum / count;
        if (const int enters = i + half + 1; enters < n)
          sum += sums[enters];
        else if (periodic)
          sum += sums[enters - n];
        if (const int leaves = i - half; leaves >= 0)
          sum -= sums[leaves];
        else if (periodic)
          sum -= sums[leaves + n];
      }
    }
  });
}

void LongWaveFlux::smooth_along() {
  const int n = frame_.stations();
  const int half = half_along_;
  const bool periodic = frame_.periodic();
  const int blocks = (frame_.rows() + rows_at_once - 1) / rows_at_once;
  tbb::parallel_for(0, blocks, [&](int block) {
    const int begin = block * rows_at_once;
    const int count = std::min(rows_at_once, frame_.rows() - begin);
    const std::vector<double> nothing(static_cast<std::size_t>(count), 0.0);
    std::vector<double> sum;
    for (int pass = 0; pass < means; ++pass) {
      const FrameField& from = pass % 2 == 0 ? smooth_ : sums_;
      FrameField& to = pass % 2 == 0 ? sums_ : smooth_;
      const auto at = [&](int station) {
        return periodic || (station >= 0 && station < n) ? from.at(wrapped(station, n)) + begin
                                                         : nothing.data();
      };
      sum = nothing;
      for (int i = -half; i <= half; ++i) slide(count, at(i), nothing.data(), sum.data());
      for (int i = 0; i < n; ++i) {
        const int cells = periodic ? 2 * half + 1 : std::min(i + half, n - 1) - std::max(i - half, 0) + 1;
        scaled(count, 1.0 / cells, sum.data(), to.at(i) + begin);
        slide(count, at(i + half + 1), at(i - half), sum.data());
      }
    }
  });
  static_assert(means % 2 == 1);
  smooth_.swap(sums_);
}

void LongWaveFlux::smooth(const FrameField& dune, const FrameField& bed) {
  for (int i = 0; i < frame_.stations(); ++i) above(frame_.rows(), bed.at(i), dune.at(i), smooth_.at(i));
  smooth_across();
  smooth_along();
  for (int i = 0; i < frame_.stations(); ++i) smooth_.fill_pads(i, frame_.periodic());
}

/// A quarter of what lies in a cell may leave it across each face, so flows are taken from the bed as it was:
/// all of a station's before its neighbour's are added.
void LongWaveFlux::move(double gain, const HardGround* ground, const ActivePatches& active, FrameField& bed) {
  const int n = frame_.stations();
  const int rows = frame_.rows();
  const bool periodic = frame_.periodic();
  FrameField& change = sums_;
  for (int i = 0; i < n; ++i) std::fill(change.at(i), change.at(i) + rows, 0.0);
  double flow[ActivePatches::rows_each];
  const auto between = [&](int station, int row, int other, int other_row, int count) {
    exchange(count, gain, smooth_.at(station) + row, smooth_.at(other) + other_row, flow);
    if (ground)
      limit(count, bed.at(station) + row, ground->floor.at(station) + row, ground->open.at(station) + row,
            bed.at(other) + other_row, ground->floor.at(other) + other_row,
            ground->open.at(other) + other_row, flow);
    for (int k = 0; k < count; ++k) change.at(station)[row + k] -= flow[k];
    for (int k = 0; k < count; ++k) change.at(other)[other_row + k] += flow[k];
  };
  active.for_all([&](int station, int patch, int begin, int end) {
    const int behind = station + 1 < n ? station + 1 : periodic ? 0 : station;
    if (behind != station && active.get(behind, patch)) between(station, begin, behind, begin, end - begin);
    between(station, begin, station, begin + 1, end - begin - 1);
    if (end < rows && active.get(station, patch + 1)) between(station, end - 1, station, end, 1);
    if (end == rows && periodic && rows > 1 && active.get(station, 0))
      between(station, end - 1, station, 0, 1);
  });
  for (int i = 0; i < n; ++i) {
    for (int row = 0; row < rows; ++row) bed.at(i)[row] += change.at(i)[row];
    bed.fill_pads(i, periodic);
  }
}

void LongWaveFlux::run(const FrameField& dune, double duration, const HardGround* ground,
                       const ActivePatches& active, FrameField& bed) {
  const double times = std::max(1.0, std::ceil(rate_ * duration / most_decay));
  const double gain = diffusivity_ * duration / times / (cell_ * cell_);
  for (double i = 0; i < times; ++i) {
    smooth(dune, bed);
    move(gain, ground, active, bed);
  }
}

}  // namespace aeolian
