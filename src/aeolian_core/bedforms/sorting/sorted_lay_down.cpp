#include "aeolian_core/bedforms/sorting/sorted_lay_down.hpp"

#include <algorithm>
#include <vector>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_at_once = 16;
constexpr int sizes = SortedSweep::sizes;

/// Rows from the lines on both sides of each.
AEOLIAN_KERNEL void scatter(std::ptrdiff_t count, double upper, const double* __restrict lines,
                            double* __restrict rows) {
  for (std::ptrdiff_t i = 0; i < count; ++i) rows[i] = lines[i + 1] + upper * (lines[i] - lines[i + 1]);
}

struct Step {
  double depth, upper, coarse_mobility, coarse_hop_ratio;
};

AEOLIAN_KERNEL void update(std::ptrdiff_t count, const Step& given, const double* __restrict fine_struck,
                           const double* __restrict coarse_struck, const double* __restrict fine,
                           const double* __restrict coarse, double* __restrict bed,
                           double* __restrict thickness, double* __restrict layer_coarse,
                           double* __restrict fraction, double* __restrict activity,
                           double* __restrict fine_eroded, double* __restrict coarse_eroded,
                           double* __restrict strongest) {
  const Step s = given;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double part = fraction[i];
    const double fine_lost =
        (1 - part) * (fine_struck[i + 1] + s.upper * (fine_struck[i] - fine_struck[i + 1]));
    const double coarse_lost = s.coarse_mobility * part *
                               (coarse_struck[i + 1] + s.upper * (coarse_struck[i] - coarse_struck[i + 1]));
    const double coarse_change = s.depth * (coarse[i] - coarse_lost);
    const double change = s.depth * (fine[i] - fine_lost) + coarse_change;
    bed[i] += change;
    thickness[i] += change;
    layer_coarse[i] += coarse_change;
    fraction[i] = coarse_part(layer_coarse[i], thickness[i]);
    const double active = fine[i] + s.coarse_hop_ratio * coarse[i];
    activity[i] = active > 0 ? active : 0;
    fine_eroded[i] += fine_lost;
    coarse_eroded[i] += coarse_lost;
    strongest[i] = strongest[i] > active ? strongest[i] : active;
  }
}

double sum(const std::vector<double>& values) {
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

}  // namespace

SortedLaidDown lay_down(const WindFrame& frame, const SortedSweep& sweep,
                        const std::array<LateralSpread, sizes>& spread, double depth, double coarse_hop_ratio,
                        FrameField& bed, ActiveLayer& layer, FrameField& activity) {
  const int n = frame.stations();
  const int rows = frame.rows();
  const bool periodic = frame.periodic();

  const auto lay_down_block = [&](int begin, int end, SortedLaidDown& result) {
    std::array<FrameField, sizes> deposition;
    for (std::size_t s = 0; s < sizes; ++s) {
      deposition[s] = FrameField(end - begin, rows);
      const int from = periodic ? begin - spread[s].reach() : std::max(0, begin - spread[s].reach());
      const int to = periodic ? end + spread[s].reach() : std::min(n, end + spread[s].reach());
      LateralSpread::Stream stream(spread[s], from, to, 0, rows, nullptr);
      for (int i = from; i < to; ++i) {
        const int station = wrapped(i, n);
        scatter(rows, frame.place(station).upper, sweep.deposition()[s].at(station), stream.next());
        stream.push([&](int complete, const double* values) {
          if (complete >= begin && complete < end)
            std::copy_n(values, rows, deposition[s].at(complete - begin));
        });
      }
    }
    const auto count = static_cast<std::size_t>(rows);
    std::array<std::vector<double>, sizes> eroded{std::vector<double>(count), std::vector<double>(count)};
    std::vector<double> strongest(count);
    for (int i = begin; i < end; ++i) {
      const double upper = frame.place(i).upper;
      double* const fraction = layer.fraction().at(i);
      if (!periodic)
        // The share of the outermost lines that falls beside the grid has crossed its border.
        for (std::size_t s = 0; s < sizes; ++s) {
          const double* const struck = sweep.struck()[s].at(i);
          const double* const fallen = sweep.deposition()[s].at(i);
          result.inflow[s] += (1 - upper) * struck[0] * sweep.law()[s].share(fraction[-1]) +
                              upper * struck[rows] * sweep.law()[s].share(fraction[rows]);
          result.outflow[s] += (1 - upper) * fallen[0] + upper * fallen[rows];
        }
      update(rows, {depth, upper, sweep.law()[1].mobility, coarse_hop_ratio}, sweep.struck()[0].at(i),
             sweep.struck()[1].at(i), deposition[0].at(i - begin), deposition[1].at(i - begin), bed.at(i),
             layer.thickness().at(i), layer.coarse().at(i), fraction, activity.at(i), eroded[0].data(),
             eroded[1].data(), strongest.data());
      layer.fraction().fill_pads(i, periodic);
      bed.fill_pads(i, periodic);
      activity.fill_pads(i, periodic);
    }
    for (std::size_t s = 0; s < sizes; ++s) result.eroded[s] = sum(eroded[s]);
    result.strongest = *std::max_element(strongest.begin(), strongest.end());
  };

  const int blocks = (n + stations_at_once - 1) / stations_at_once;
  std::vector<SortedLaidDown> parts(static_cast<std::size_t>(blocks));
  tbb::parallel_for(0, blocks, [&](int block) {
    const int begin = block * stations_at_once;
    lay_down_block(begin, std::min(begin + stations_at_once, n), parts[static_cast<std::size_t>(block)]);
  });
  SortedLaidDown result;
  for (std::size_t s = 0; s < sizes; ++s) {
    result.inflow[s] = sweep.inflow(static_cast<int>(s));
    result.outflow[s] = sweep.outflow(static_cast<int>(s));
    for (const SortedLaidDown& part : parts) {
      result.eroded[s] += part.eroded[s];
      result.inflow[s] += part.inflow[s];
      result.outflow[s] += part.outflow[s];
    }
  }
  for (const SortedLaidDown& part : parts) result.strongest = std::max(result.strongest, part.strongest);
  return result;
}

}  // namespace aeolian
