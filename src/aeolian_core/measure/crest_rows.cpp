#include "aeolian_core/measure/crest_rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace aeolian {
namespace {

constexpr float none = std::numeric_limits<float>::quiet_NaN();

/// An extremum among samples, refined by the parabola through its neighbours.
struct Turn {
  float place = none;
  float height = none;
};

Turn refined(const float* row, int at, int first, int last) {
  if (at <= first || at >= last) return {static_cast<float>(at), row[at]};
  const float curvature = row[at - 1] - 2 * row[at] + row[at + 1];
  if (curvature == 0) return {static_cast<float>(at), row[at]};
  const float slope = 0.5F * (row[at + 1] - row[at - 1]);
  const float offset = std::clamp(-slope / curvature, -0.5F, 0.5F);
  return {static_cast<float>(at) + offset, row[at] + 0.5F * slope * offset};
}

/// The steepest rise (per sample) over `span` samples between two places, times `sign`; NaN when they are
/// nearer than that.
float steepest(const float* row, float from, float to, int span, float sign) {
  float best = none;
  for (int i = static_cast<int>(std::ceil(from)); i + span <= static_cast<int>(to); ++i) {
    const float slope = sign * (row[i + span] - row[i]) / static_cast<float>(span);
    if (!(slope <= best)) best = slope;
  }
  return best;
}

/// Appends the crests of samples first..last, all seen.
void scan(const float* row, int first, int last, float prominence, int stretch,
          std::vector<RowCrest>& crests) {
  const std::size_t start = crests.size();
  std::vector<Turn> troughs(1);  // before each crest and after the last
  int lowest = first;
  int highest = first;
  float fall = 0;  // from the last crest, or from the highest so far, to the lowest
  float before_highest = row[first];
  bool rising = false;
  for (int i = first; i <= last; ++i) {
    if (rising) {
      if (row[i] > row[highest]) highest = i;
      if (row[i] >= row[highest] - prominence) continue;
      const Turn top = refined(row, highest, first, last);
      RowCrest crest;
      crest.place = top.place;
      crest.height = top.height;
      crest.stretch = stretch;
      crests.push_back(crest);
      troughs.emplace_back();
      rising = false;
      lowest = i;
      fall = row[highest] - row[i];
    } else {
      if (row[i] > before_highest && crests.size() == start) before_highest = row[i];
      if (row[i] < row[lowest]) lowest = i;
      if (crests.size() == start) fall = std::max(fall, before_highest - row[lowest]);
      if (row[i] <= row[lowest] + prominence) continue;
      if (crests.size() > start || fall >= prominence) troughs.back() = refined(row, lowest, first, last);
      rising = true;
      highest = i;
    }
  }
  for (std::size_t c = start; c < crests.size(); ++c) {
    const Turn& up = troughs[c - start];
    const Turn& down = troughs[c - start + 1];
    crests[c].upwind_trough = up.place;
    crests[c].upwind_floor = up.height;
    crests[c].downwind_trough = down.place;
    crests[c].downwind_floor = down.height;
  }
}

}  // namespace

std::vector<RowCrest> row_crests(const RippleRelief& relief, int row, double prominence) {
  const int span = std::max(1, static_cast<int>(std::lround(0.1 * relief.pattern.wavelength / relief.cell)));
  const float* height = relief.height.data() + relief.index(row, 0);
  const float* clearance = relief.clearance.data() + relief.index(row, 0);
  std::vector<RowCrest> crests;
  int stretch = 0;
  for (int first = 0; first < relief.length; ++first) {
    if (clearance[first] <= 0) continue;
    int last = first;
    while (last + 1 < relief.length && clearance[last + 1] > 0) ++last;
    scan(height, first, last, static_cast<float>(prominence), stretch++, crests);
    first = last + 1;
  }
  const auto per_sample = static_cast<float>(1 / relief.cell);
  for (RowCrest& crest : crests) {
    crest.prominence = std::fmin(crest.height - crest.upwind_floor, crest.height - crest.downwind_floor);
    crest.steepest_rise = per_sample * steepest(height, crest.upwind_trough, crest.place, span, 1);
    crest.steepest_fall = per_sample * steepest(height, crest.place, crest.downwind_trough, span, -1);
  }
  return crests;
}

}  // namespace aeolian
