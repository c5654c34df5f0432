#include "aeolian_core/bedforms/height_map/lay_down.hpp"

#include <algorithm>
#include <vector>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_at_once = 32;

/// Rows from the lines on both sides of each.
AEOLIAN_WIDE_KERNEL void scatter(std::ptrdiff_t count, double upper, const double* __restrict lines,
                                 double* __restrict rows) {
  for (std::ptrdiff_t i = 0; i < count; ++i) rows[i] = lines[i + 1] + upper * (lines[i] - lines[i + 1]);
}

AEOLIAN_WIDE_KERNEL void update(std::ptrdiff_t count, double depth, double upper,
                                const double* __restrict erosion, const double* __restrict deposition,
                                double* __restrict bed, double* __restrict activity) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double lost = erosion[i + 1] + upper * (erosion[i] - erosion[i + 1]);
    const double gained = deposition[i];
    bed[i] += depth * (gained - lost);
    activity[i] = gained > 0 ? gained : 0;
  }
}

constexpr int lanes = 8;

AEOLIAN_WIDE_KERNEL double sum(std::ptrdiff_t count, const double* __restrict values) {
  double sums[lanes] = {};
  const std::ptrdiff_t whole = count / lanes * lanes;
  for (std::ptrdiff_t i = 0; i < whole; i += lanes)
    for (int k = 0; k < lanes; ++k) sums[k] += values[i + k];
  for (std::ptrdiff_t i = whole; i < count; ++i) sums[i - whole] += values[i];
  double total = 0;
  for (const double part : sums) total += part;
  return total;
}

AEOLIAN_WIDE_KERNEL double largest(std::ptrdiff_t count, const double* __restrict values) {
  double most[lanes] = {};
  const std::ptrdiff_t whole = count / lanes * lanes;
  for (std::ptrdiff_t i = 0; i < whole; i += lanes)
    for (int k = 0; k < lanes; ++k) most[k] = values[i + k] > most[k] ? values[i + k] : most[k];
  for (std::ptrdiff_t i = whole; i < count; ++i) most[0] = std::max(most[0], values[i]);
  return *std::max_element(most, most + lanes);
}

struct Rows {
  int begin, end;
};

/// The rows from the first to the last active patch among some stations.
Rows hull(const ActivePatches& active, int rows, int begin, int end) {
  Rows result{rows, 0};
  for (int i = begin; i < end; ++i)
    active.for_runs(i, [&](int from, int to) {
      result.begin = std::min(result.begin, from);
      result.end = std::max(result.end, to);
    });
  return result;
}

struct LayDown {
  const WindFrame& frame;
  const ImpactSweep& sweep;
  const LateralSpread& spread;
  double depth;
  const FrameField* open;
  const SlopeBias* bias;
  const ActivePatches& active;
  FrameField& bed;
  FrameField& activity;

  LaidDown run(int begin, int end) const;
};

LaidDown LayDown::run(int begin, int end) const {
  LaidDown result;
  const int n = frame.stations();
  const int rows = frame.rows();
  const bool periodic = frame.periodic();
  const Rows live = hull(active, rows, begin, end);
  if (live.begin >= live.end) return result;
  const int from = periodic ? begin - spread.reach() : std::max(0, begin - spread.reach());
  const int to = periodic ? end + spread.reach() : std::min(n, end + spread.reach());
  const int first_row = std::max(0, live.begin - FrameField::pad);
  const int last_row = std::min(rows, live.end + FrameField::pad);
  const int count = live.end - live.begin;
  const auto finish = [&](int i, const double* deposition) {
    if (i < begin || i >= end) return;
    const double upper = frame.place(i).upper;
    const double* const lost = sweep.erosion().at(i) + live.begin;
    double* const active_here = activity.at(i) + live.begin;
    update(count, depth, upper, lost, deposition + live.begin, bed.at(i) + live.begin, active_here);
    result.eroded += sum(count, lost + 1) + upper * (lost[0] - lost[count]);
    if (!bias) result.strongest = std::max(result.strongest, largest(count, active_here));
    bed.fill_pads(i, periodic);
    activity.fill_pads(i, periodic);
    // One station behind, while its heights are in a cache; the block's first and last wait for other blocks.
    if (bias && i - 1 > begin)
      result.strongest = std::max(result.strongest, bias->stiffen(i - 1, bed, active, activity));
    if (periodic) return;
    // The share of the outermost lines that falls beside the grid has crossed its border.
    result.inflow += (1 - upper) * sweep.erosion().at(i)[0] + upper * sweep.erosion().at(i)[rows];
    result.outflow += (1 - upper) * sweep.deposition().at(i)[0] + upper * sweep.deposition().at(i)[rows];
  };
  LateralSpread::Stream stream(spread, from, to, live.begin, live.end, open);
  for (int i = from; i < to; ++i) {
    const int station = wrapped(i, n);
    scatter(last_row - first_row, frame.place(station).upper, sweep.deposition().at(station) + first_row,
            stream.next() + first_row);
    stream.push(finish);
  }
  return result;
}

/// Adds the patches that are within reach of active ones.
void widen(const WindFrame& frame, const LateralSpread& spread, ActivePatches& active) {
  const ActivePatches before = active;
  const int n = frame.stations();
  for (int i = 0; i < n; ++i)
    before.for_runs(i, [&](int begin, int end) {
      for (int k = i - spread.reach() - 1; k <= i + spread.reach() + 1; ++k) {
        if (!frame.periodic() && (k < 0 || k >= n)) continue;
        active.activate_rows(wrapped(k, n), begin - spread.reach_across() - 1,
                             end + spread.reach_across() + 1);
        if (!frame.periodic()) continue;
        if (begin == 0) active.activate_rows(wrapped(k, n), frame.rows() - 1, frame.rows());
        if (end == frame.rows()) active.activate_rows(wrapped(k, n), 0, 1);
      }
    });
}

}  // namespace

LaidDown lay_down(const WindFrame& frame, const ImpactSweep& sweep, const LateralSpread& spread, double depth,
                  const FrameField* open, const SlopeBias* bias, ActivePatches& active, FrameField& bed,
                  FrameField& activity) {
  if (open) widen(frame, spread, active);
  const LayDown work{frame, sweep, spread, depth, open, bias, active, bed, activity};
  const int blocks = (frame.stations() + stations_at_once - 1) / stations_at_once;
  std::vector<LaidDown> parts(static_cast<std::size_t>(blocks));
  tbb::parallel_for(0, blocks, [&](int block) {
    const int begin = block * stations_at_once;
    parts[static_cast<std::size_t>(block)] =
        work.run(begin, std::min(begin + stations_at_once, frame.stations()));
  });
  LaidDown result{0, sweep.inflow(), sweep.outflow(), 0};
  for (const LaidDown& part : parts) {
    result.eroded += part.eroded;
    result.inflow += part.inflow;
    result.outflow += part.outflow;
    result.strongest = std::max(result.strongest, part.strongest);
  }
  if (!bias) return result;
  const auto stiffen_here = [&](int i) {
    result.strongest = std::max(result.strongest, bias->stiffen(i, bed, active, activity));
  };
  for (int begin = 0; begin < frame.stations(); begin += stations_at_once) {
    const int last = std::min(begin + stations_at_once, frame.stations()) - 1;
    stiffen_here(begin);
    if (last > begin) stiffen_here(last);
  }
  return result;
}

}  // namespace aeolian
