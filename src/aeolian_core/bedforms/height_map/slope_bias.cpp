#include "aeolian_core/bedforms/height_map/slope_bias.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr double most = 8;  ///< slopes are kept by avalanches beyond it
constexpr int stations_at_once = 16;

/// A station's heights and those before and behind it.
struct Rows {
  const double* here;
  const double* before;
  const double* behind;
};

AEOLIAN_WIDE_KERNEL double stiffen_rows(std::ptrdiff_t count, double per_height, Rows bed, Rows dune,
                                        double* __restrict activity) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double along = (bed.behind[i] - bed.before[i]) - (dune.behind[i] - dune.before[i]);
    const double across = (bed.here[i + 1] - bed.here[i - 1]) - (dune.here[i + 1] - dune.here[i - 1]);
    const double steep = per_height * (along * along + across * across);
    activity[i] *= 1 + (steep < most ? steep : most);
  }
  constexpr int lanes = 8;
  double strongest[lanes] = {};
  const std::ptrdiff_t whole = count / lanes * lanes;
  for (std::ptrdiff_t i = 0; i < whole; i += lanes)
    for (int k = 0; k < lanes; ++k)
      strongest[k] = activity[i + k] > strongest[k] ? activity[i + k] : strongest[k];
  for (std::ptrdiff_t i = whole; i < count; ++i) strongest[0] = std::max(strongest[0], activity[i]);
  return *std::max_element(strongest, strongest + lanes);
}

}  // namespace

SlopeBias::SlopeBias(const WindFrame& frame, double cell, double tan_doubling_slope, const FrameField& dune)
    : frame_(frame), per_height_(std::pow(1 / (2 * cell * tan_doubling_slope), 2)), dune_(dune) {}

double SlopeBias::stiffen(int station, const FrameField& bed, const ActivePatches& active,
                          FrameField& activity) const {
  const int n = frame_.stations();
  const int before = station > 0 ? station - 1 : frame_.periodic() ? n - 1 : 0;
  const int behind = station + 1 < n ? station + 1 : frame_.periodic() ? 0 : station;
  double strongest = 0;
  active.for_runs(station, [&](int begin, int end) {
    const auto rows_of = [&](const FrameField& field) {
      return Rows{field.at(station) + begin, field.at(before) + begin, field.at(behind) + begin};
    };
    strongest = std::max(strongest, stiffen_rows(end - begin, per_height_, rows_of(bed), rows_of(dune_),
                                                 activity.at(station) + begin));
  });
  activity.fill_pads(station, frame_.periodic());
  return strongest;
}

double stiffen(const WindFrame& frame, double cell, double tan_doubling_slope, const FrameField& dune,
               const FrameField& bed, const ActivePatches& active, FrameField& activity) {
  const SlopeBias bias(frame, cell, tan_doubling_slope, dune);
  const int n = frame.stations();
  const int blocks = (n + stations_at_once - 1) / stations_at_once;
  std::vector<double> strongest(static_cast<std::size_t>(blocks), 0.0);
  tbb::parallel_for(0, blocks, [&](int block) {
    double& here = strongest[static_cast<std::size_t>(block)];
    for (int i = block * stations_at_once; i < std::min((block + 1) * stations_at_once, n); ++i)
      here = std::max(here, bias.stiffen(i, bed, active, activity));
  });
  return *std::max_element(strongest.begin(), strongest.end());
}

}  // namespace aeolian
