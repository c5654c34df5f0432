#include "aeolian_core/bedforms/height_map/avalanche.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/parallel_for.h>

#include "aeolian_core/bedforms/height_map/repose.hpp"
#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int patch_rows = ActivePatches::rows_each;
constexpr int strip = 32;  ///< stations that are relaxed by themselves before what crosses their ends

AEOLIAN_INLINE double size(double x) { return x < 0 ? -x : x; }

/// Lowers and raises the limits of heights and floors by those of some rows. Whether all are open.
AEOLIAN_WIDE_KERNEL bool lies_deep(std::ptrdiff_t count, const double* __restrict h,
                                   const double* __restrict floor, const double* __restrict open,
                                   double& lowest, double& highest_floor) {
  constexpr int lanes = 8;
  double low[lanes], high[lanes], least_open[lanes];
  std::fill_n(low, lanes, lowest);
  std::fill_n(high, lanes, highest_floor);
  std::fill_n(least_open, lanes, 1.0);
  const std::ptrdiff_t whole = count / lanes * lanes;
  for (std::ptrdiff_t i = 0; i < count; i += i < whole ? lanes : 1)
    for (int k = 0; k < (i < whole ? lanes : 1); ++k) {
      low[k] = h[i + k] < low[k] ? h[i + k] : low[k];
      high[k] = floor[i + k] > high[k] ? floor[i + k] : high[k];
      least_open[k] = open[i + k] < least_open[k] ? open[i + k] : least_open[k];
    }
  lowest = *std::min_element(low, low + lanes);
  highest_floor = *std::max_element(high, high + lanes);
  return *std::min_element(least_open, least_open + lanes) > 0;
}

/// Exchange between h[i] and other[i].
AEOLIAN_WIDE_KERNEL void relax_pairs(std::ptrdiff_t count, double straight, double* __restrict h,
                                     double* __restrict other, double* __restrict moved) {
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double amount = slide(h[i] - other[i], straight, 0.5);
    h[i] -= amount;
    other[i] += amount;
    moved[i] += size(amount);
  }
}

/// Exchange between neighbours of one row, all at once, hence only a third.
AEOLIAN_WIDE_KERNEL void relax_row(std::ptrdiff_t pairs, double straight, double* __restrict h,
                                   double* __restrict moved) {
  double amount[patch_rows];
  for (std::ptrdiff_t i = 0; i < pairs; ++i) {
    amount[i] = slide(h[i] - h[i + 1], straight, 1.0 / 3);
    moved[i] += size(amount[i]);
  }
  for (std::ptrdiff_t i = 0; i < pairs; ++i) h[i] -= amount[i];
  for (std::ptrdiff_t i = 0; i < pairs; ++i) h[i + 1] += amount[i];
}

}  // namespace

Avalanches::Avalanches(int stations, int rows, double cell, double tan_repose, bool periodic)
    : stations_(stations),
      rows_(rows),
      patches_((rows + patch_rows - 1) / patch_rows),
      area_(cell * cell),
      straight_(tan_repose * cell),
      periodic_(periodic),
      disturbed_(static_cast<std::size_t>(stations) * static_cast<std::size_t>(patches_)) {}

/// The station behind; itself behind the last of an open field.
int Avalanches::next(int station) const {
  return station + 1 < stations_ ? station + 1 : periodic_ ? 0 : station;
}

bool Avalanches::steep(const FrameField& height, int station, int patch) const {
  const int begin = patch * patch_rows;
  const int count = std::min(patch_rows, rows_ - begin);
  const bool last = begin + count == rows_;
  const double* const h = height.at(station);
  const double* const behind = height.at(next(station));
  if (any_steep(count, last ? count - 1 : count, straight_, h + begin, behind + begin)) return true;
  if (!last || !periodic_) return false;
  const double along = straight_ * (1 + repose_slack);
  const int end = rows_ - 1;
  return std::abs(h[0] - h[end]) > along || std::abs(behind[0] - h[end]) > along * diagonal ||
         std::abs(behind[end] - h[0]) > along * diagonal;
}

/// One round of exchanges among the slopes of a patch. Returns the sum of the heights moved.
double Avalanches::relax(FrameField& height, int station, int patch) {
  const int begin = patch * patch_rows;
  const int count = std::min(patch_rows, rows_ - begin);
  const bool last = begin + count == rows_;
  const int ahead = last ? count - 1 : count;
  double* const h = height.at(station) + begin;
  double* const behind = height.at(next(station)) + begin;
  std::array<double, patch_rows> moved{};
  if (next(station) != station) {
    relax_pairs(count, straight_, h, behind, moved.data());
    relax_pairs(ahead, straight_ * diagonal, h, behind + 1, moved.data());
    relax_pairs(ahead, straight_ * diagonal, h + 1, behind, moved.data());
  }
  relax_row(ahead, straight_, h, moved.data());
  if (last && periodic_) {
    double* const first = height.at(station);
    double* const first_behind = height.at(next(station));
    relax_pairs(1, straight_, h + count - 1, first, moved.data());
    relax_pairs(1, straight_ * diagonal, h + count - 1, first_behind, moved.data());
    relax_pairs(1, straight_ * diagonal, first, behind + count - 1, moved.data());
  }
  double sum = 0;
  for (const double m : moved) sum += m;
  return sum;
}

/// Has the patches around one that moved looked at, among the stations [begin, end).
void Avalanches::disturb(int station, int patch, int begin, int end) {
  const bool round = periodic_ && begin == 0 && end == stations_;
  for (int i = station - 1; i <= station + 1; ++i) {
    const int at = round ? (i + stations_) % stations_ : i;
    if (at < begin || at >= end) continue;
    for (int p = patch - 1; p <= patch + 1; ++p) {
      const int there = periodic_ ? (p + patches_) % patches_ : p;
      if (there < 0 || there >= patches_) continue;
      disturbed_[static_cast<std::size_t>(at) * static_cast<std::size_t>(patches_) +
                 static_cast<std::size_t>(there)] = 1;
    }
  }
}

/// Whether the ground is open and nowhere higher than the lowest bed in reach of a patch's slides, so that
/// they cannot run out of sand.
bool Avalanches::is_deep(const FrameField& height, const HardGround& ground, int station, int patch) const {
  const int begin = patch * patch_rows;
  const int count = std::min(patch_rows, rows_ - begin);
  if (periodic_ && begin + count == rows_) return false;
  const int there = begin + count == rows_ ? count : count + 1;
  double lowest = height.at(station)[begin];
  double highest_floor = ground.floor.at(station)[begin];
  for (const int i : {station, next(station)})
    if (!lies_deep(there, height.at(i) + begin, ground.floor.at(i) + begin, ground.open.at(i) + begin, lowest,
                   highest_floor))
      return false;
  return highest_floor <= lowest;
}

/// As relax(), cell by cell.
double Avalanches::relax_on_ground(FrameField& height, const HardGround& ground, int station, int patch) {
  if (is_deep(height, ground, station, patch)) return relax(height, station, patch);
  const int begin = patch * patch_rows;
  const int end = std::min(begin + patch_rows, rows_);
  const int behind = next(station);
  double sum = 0;
  const auto exchange = [&](int i, int row, int other, int other_row, double straight) {
    if (other_row >= rows_) {
      if (!periodic_) return;
      other_row -= rows_;
    }
    if (row >= rows_) {
      if (!periodic_) return;
      row -= rows_;
    }
    if (ground.open.at(i)[row] * ground.open.at(other)[other_row] == 0) return;
    double& h = height.at(i)[row];
    double& o = height.at(other)[other_row];
    const double wanted = slide(h - o, straight, 0.5);
    const double above = wanted > 0 ? h - ground.floor.at(i)[row] : o - ground.floor.at(other)[other_row];
    const double amount = std::copysign(std::min(std::abs(wanted), std::max(0.0, above)), wanted);
    h -= amount;
    o += amount;
    sum += std::abs(amount);
  };
  for (int row = begin; row < end; ++row) {
    if (behind != station) {
      exchange(station, row, behind, row, straight_);
      exchange(station, row, behind, row + 1, straight_ * diagonal);
      exchange(station, row + 1, behind, row, straight_ * diagonal);
    }
    exchange(station, row, station, row + 1, straight_);
  }
  return sum;
}

/// Relaxes the disturbed patches of the stations [begin, end) until none is too steep or nothing moves there.
/// Downwind, which for ripples is down the steep side.
template <class Relax>
double Avalanches::relax_strip(const FrameField& height, int begin, int end, Relax&& relax_patch) {
  double moved = 0;
  for (bool any = true; any;) {
    any = false;
    for (int station = begin; station < end; ++station)
      for (int patch = 0; patch < patches_; ++patch) {
        std::uint8_t& disturbed =
            disturbed_[static_cast<std::size_t>(station) * static_cast<std::size_t>(patches_) +
                       static_cast<std::size_t>(patch)];
        if (!disturbed) continue;
        disturbed = 0;
        if (!steep(height, station, patch)) continue;
        const double now = relax_patch(station, patch);
        if (!(now > 1e-9 * straight_)) continue;
        moved += now;
        disturb(station, patch, begin, end);
        any = true;
      }
  }
  return moved;
}

template <class Relax>
double Avalanches::relax_all(FrameField& height, const ActivePatches* active, Relax&& relax_patch) {
  const int strips = (stations_ + strip - 1) / strip;
  const auto look_at = [&](int station) {
    for (int patch = 0; patch < patches_; ++patch)
      if (!active || active->get(station, patch))
        disturbed_[static_cast<std::size_t>(station) * static_cast<std::size_t>(patches_) +
                   static_cast<std::size_t>(patch)] = 1;
  };
  std::vector<double> moved(static_cast<std::size_t>(strips));
  tbb::parallel_for(0, strips, [&](int n) {
    const int begin = n * strip;
    const int end = std::min(begin + strip, stations_) - 1;  // the last one's slopes reach the next strip
    for (int station = begin; station < end; ++station) look_at(station);
    moved[static_cast<std::size_t>(n)] = relax_strip(height, begin, end, relax_patch);
  });
  for (int n = 0; n < strips; ++n) look_at(std::min((n + 1) * strip, stations_) - 1);
  double total = relax_strip(height, 0, stations_, relax_patch);
  for (const double m : moved) total += m;
  if (total > 0)
    for (int i = 0; i < stations_; ++i) height.fill_pads(i, periodic_);
  return total * area_;
}

double Avalanches::run(FrameField& height) {
  return relax_all(height, nullptr, [&](int station, int patch) { return relax(height, station, patch); });
}

double Avalanches::run(FrameField& height, const HardGround& ground, ActivePatches& active) {
  // Slides beyond an active patch make their own patches active. Several strips may flag one patch: later.
  std::vector<std::uint8_t> slid(disturbed_.size(), 0);
  const double moved = relax_all(height, &active, [&](int station, int patch) {
    const double amount = relax_on_ground(height, ground, station, patch);
    if (amount > 0)
      slid[static_cast<std::size_t>(station) * static_cast<std::size_t>(patches_) +
           static_cast<std::size_t>(patch)] = 1;
    return amount;
  });
  for (int station = 0; station < stations_; ++station)
    for (int patch = 0; patch < patches_; ++patch) {
      if (!slid[static_cast<std::size_t>(station) * static_cast<std::size_t>(patches_) +
                static_cast<std::size_t>(patch)])
        continue;
      for (const int i : {station, next(station)}) {
        active.set(i, patch, true);
        active.set(i, patch + 1 < patches_ ? patch + 1 : periodic_ ? 0 : patch, true);
      }
    }
  return moved;
}

}  // namespace aeolian
