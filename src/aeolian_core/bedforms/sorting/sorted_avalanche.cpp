#include "aeolian_core/bedforms/sorting/sorted_avalanche.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/height_map/repose.hpp"

namespace aeolian {
namespace {

constexpr int patch_rows = 32;
constexpr int strip = 32;  ///< stations that are relaxed by themselves before what crosses their ends

}  // namespace

SortedAvalanches::SortedAvalanches(const WindFrame& frame, double cell, double tan_repose)
    : stations_(frame.stations()),
      rows_(frame.rows()),
      patches_((frame.rows() + patch_rows - 1) / patch_rows),
      area_(cell * cell),
      straight_(tan_repose * cell),
      periodic_(frame.periodic()),
      disturbed_(static_cast<std::size_t>(stations_) * static_cast<std::size_t>(patches_)) {}

/// The station behind; itself behind the last of an open field.
int SortedAvalanches::next(int station) const {
  return station + 1 < stations_ ? station + 1 : periodic_ ? 0 : station;
}

bool SortedAvalanches::steep(const FrameField& height, int station, int patch) const {
  const int begin = patch * patch_rows;
  const int count = std::min(patch_rows, rows_ - begin);
  // The pads behind the last row of a periodic field are its first rows.
  const bool ends = begin + count == rows_ && !periodic_;
  return any_steep(count, ends ? count - 1 : count, straight_, height.at(station) + begin,
                   height.at(next(station)) + begin);
}

/// One round of exchanges among the slopes of a patch. Returns the sum of the heights moved.
double SortedAvalanches::relax(FrameField& height, ActiveLayer& layer, int station, int patch) {
  const int begin = patch * patch_rows;
  const int end = std::min(begin + patch_rows, rows_);
  const bool last = end == rows_;
  const int pairs_end = last ? end - 1 : end;
  const int behind = next(station);
  double sum = 0;
  const auto move = [&](int i, int row, int j, int other, double amount) {
    height.at(i)[row] -= amount;
    height.at(j)[other] += amount;
    if (amount > 0)
      layer.give(i, row, j, other, amount);
    else
      layer.give(j, other, i, row, -amount);
    sum += std::abs(amount);
  };
  const auto exchange = [&](int i, int row, int j, int other, double straight) {
    const double amount = slide(height.at(i)[row] - height.at(j)[other], straight, 0.5);
    if (amount != 0) move(i, row, j, other, amount);
  };
  if (behind != station) {
    for (int row = begin; row < end; ++row) exchange(station, row, behind, row, straight_);
    for (int row = begin; row < pairs_end; ++row)
      exchange(station, row, behind, row + 1, straight_ * diagonal);
    for (int row = begin; row < pairs_end; ++row)
      exchange(station, row + 1, behind, row, straight_ * diagonal);
  }
  // All at once, hence only a third.
  std::array<double, patch_rows> amount{};
  for (int row = begin; row < pairs_end; ++row)
    amount[static_cast<std::size_t>(row - begin)] =
        slide(height.at(station)[row] - height.at(station)[row + 1], straight_, 1.0 / 3);
  for (int row = begin; row < pairs_end; ++row)
    if (const double a = amount[static_cast<std::size_t>(row - begin)]; a != 0)
      move(station, row, station, row + 1, a);
  if (last && periodic_) {
    exchange(station, end - 1, station, 0, straight_);
    exchange(station, end - 1, behind, 0, straight_ * diagonal);
    exchange(station, 0, behind, end - 1, straight_ * diagonal);
  }
  return sum;
}

/// Has the patches around one that moved looked at, among the stations [begin, end).
void SortedAvalanches::disturb(int station, int patch, int begin, int end) {
  const bool round = periodic_ && begin == 0 && end == stations_;
  for (int i = station - 1; i <= station + 1; ++i) {
    const int at = round ? (i + stations_) % stations_ : i;
    if (at < begin || at >= end) continue;
    for (int p = patch - 1; p <= patch + 1; ++p) {
      const int there = periodic_ ? (p + patches_) % patches_ : p;
      if (there >= 0 && there < patches_) disturbed(at, there) = 1;
    }
  }
}

/// Relaxes the disturbed patches of the stations [begin, end) until none is too steep or nothing moves there.
double SortedAvalanches::relax_strip(FrameField& height, ActiveLayer& layer, int begin, int end) {
  double moved = 0;
  for (bool any = true; any;) {
    any = false;
    for (int station = begin; station < end; ++station)
      for (int patch = 0; patch < patches_; ++patch) {
        if (!disturbed(station, patch)) continue;
        disturbed(station, patch) = 0;
        if (!steep(height, station, patch)) continue;
        const double now = relax(height, layer, station, patch);
        if (periodic_) {
          height.fill_pads(station, true);
          height.fill_pads(next(station), true);
        }
        if (!(now > 1e-9 * straight_)) continue;
        moved += now;
        disturb(station, patch, begin, end);
        any = true;
      }
  }
  return moved;
}

double SortedAvalanches::run(FrameField& height, ActiveLayer& layer) {
  const int strips = (stations_ + strip - 1) / strip;
  const auto look_at = [&](int station) {
    for (int patch = 0; patch < patches_; ++patch) disturbed(station, patch) = 1;
  };
  std::vector<double> moved(static_cast<std::size_t>(strips));
  tbb::parallel_for(0, strips, [&](int n) {
    const int begin = n * strip;
    const int end = std::min(begin + strip, stations_) - 1;  // the last one's slopes reach the next strip
    for (int station = begin; station < end; ++station) look_at(station);
    moved[static_cast<std::size_t>(n)] = relax_strip(height, layer, begin, end);
  });
  for (int n = 0; n < strips; ++n) look_at(std::min((n + 1) * strip, stations_) - 1);
  double total = relax_strip(height, layer, 0, stations_);
  for (const double m : moved) total += m;
  if (total > 0)
    for (int i = 0; i < stations_; ++i) height.fill_pads(i, periodic_);
  return total * area_;
}

}  // namespace aeolian
