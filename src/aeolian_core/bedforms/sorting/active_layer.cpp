#include "aeolian_core/bedforms/sorting/active_layer.hpp"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr int stations_at_once = 16;

/// A stratum thinner than this part of a full one is taken up whole.
constexpr double least_part = 1e-6;

AEOLIAN_KERNEL void mixture(std::ptrdiff_t count, const double* __restrict thickness,
                            const double* __restrict coarse, double* __restrict fraction) {
  for (std::ptrdiff_t i = 0; i < count; ++i) fraction[i] = coarse_part(coarse[i], thickness[i]);
}

/// Exchange with the stratum below. Cells whose stratum would be full or used up are left as they are and
/// counted. `largest` grows to the largest fraction.
AEOLIAN_KERNEL std::int64_t exchange(std::ptrdiff_t count, double nominal, double least, double full,
                                     double* __restrict thickness, double* __restrict coarse,
                                     double* __restrict upper, double* __restrict upper_coarse,
                                     double* __restrict fraction) {
  std::int64_t left = 0;
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const double down = thickness[i] - nominal;
    const double after = upper[i] + down;
    const bool fits = (after > least) & (after <= full);
    const double layers = coarse[i] / thickness[i];
    const double strata = upper_coarse[i] / upper[i];
    const double moved = down * (down > 0 ? layers : strata);
    left += fits ? 0 : 1;
    thickness[i] = fits ? nominal : thickness[i];
    const double c = fits ? coarse[i] - moved : coarse[i];
    coarse[i] = c;
    upper[i] = fits ? after : upper[i];
    upper_coarse[i] = fits ? upper_coarse[i] + moved : upper_coarse[i];
    fraction[i] = coarse_part(c, thickness[i]);
  }
  return left;
}

AEOLIAN_KERNEL void widen_maximum(std::ptrdiff_t count, const double* __restrict values,
                                  double* __restrict most) {
  for (std::ptrdiff_t i = 0; i < count; ++i) most[i] = most[i] > values[i] ? most[i] : values[i];
}

}  // namespace

ActiveLayer::ActiveLayer(const WindFrame& frame, SortedBed& bed)
    : frame_(frame),
      bed_(bed),
      nominal_(bed.layers.active),
      stratum_(bed.layers.stratum),
      thickness_(frame.stations(), frame.rows()),
      fraction_(frame.stations(), frame.rows()) {
  frame.enter(bed.coarse, coarse_);
  frame.enter(bed.upper, upper_);
  frame.enter(bed.upper_coarse, upper_coarse_);
  std::vector<double> cells(bed.geometry.size());
  std::iota(cells.begin(), cells.end(), 0.0);
  frame.enter(cells, cell_);
  for (int i = 0; i < frame.stations(); ++i) std::fill_n(thickness_.at(i), frame.rows(), nominal_);
  settle();
}

void ActiveLayer::mix(int station) {
  mixture(frame_.rows(), thickness_.at(station), coarse_.at(station), fraction_.at(station));
  fraction_.fill_pads(station, frame_.periodic());
}

/// The stratum below the layer is used up: the one under it takes its place.
void ActiveLayer::open_stratum(int station, int row) {
  upper_.at(station)[row] += stratum_;
  upper_coarse_.at(station)[row] += bed_.strata.unearth(cell(station, row));
}

void ActiveLayer::dig(int station, int row, double least) {
  double& thickness = thickness_.at(station)[row];
  while (thickness < least) {
    thickness += upper_.at(station)[row];
    coarse_.at(station)[row] += upper_coarse_.at(station)[row];
    upper_.at(station)[row] = upper_coarse_.at(station)[row] = 0;
    open_stratum(station, row);
  }
}

void ActiveLayer::give(int station, int row, int to_station, int to_row, double amount) {
  dig(station, row, amount);
  double& thickness = thickness_.at(station)[row];
  const double moved = std::max(0.0, coarse_.at(station)[row]) * std::min(1.0, amount / thickness);
  thickness -= amount;
  coarse_.at(station)[row] -= moved;
  thickness_.at(to_station)[to_row] += amount;
  coarse_.at(to_station)[to_row] += moved;
}

void ActiveLayer::settle_cell(int station, int row) {
  double& thickness = thickness_.at(station)[row];
  double& coarse = coarse_.at(station)[row];
  double& upper = upper_.at(station)[row];
  double& upper_coarse = upper_coarse_.at(station)[row];
  if (thickness > nominal_) {
    const double moved = coarse * ((thickness - nominal_) / thickness);
    upper += thickness - nominal_;
    upper_coarse += moved;
    coarse -= moved;
    while (upper > stratum_) {
      // What rounding takes from the stratum stays above it.
      const auto buried = static_cast<float>(upper_coarse * (stratum_ / upper));
      bed_.strata.bury(cell(station, row), buried);
      upper -= stratum_;
      upper_coarse -= static_cast<double>(buried);
    }
    if (upper <= least_part * stratum_) open_stratum(station, row);
  } else {
    double missing = nominal_ - thickness;
    while (upper - missing <= least_part * stratum_) {
      missing -= upper;
      coarse += upper_coarse;
      upper = upper_coarse = 0;
      open_stratum(station, row);
    }
    const double moved = missing * (upper_coarse / upper);
    coarse += moved;
    upper_coarse -= moved;
    upper -= missing;
  }
  thickness = nominal_;
}

void ActiveLayer::settle() {
  const int n = frame_.stations();
  const int rows = frame_.rows();
  const int blocks = (n + stations_at_once - 1) / stations_at_once;
  std::vector<double> coarsest(static_cast<std::size_t>(blocks));
  tbb::parallel_for(0, blocks, [&](int block) {
    std::vector<double> most(static_cast<std::size_t>(rows), 0.0);
    std::vector<int> unsettled;
    for (int i = block * stations_at_once; i < std::min((block + 1) * stations_at_once, n); ++i) {
      const std::int64_t left = exchange(rows, nominal_, least_part * stratum_, stratum_, thickness_.at(i),
                                         coarse_.at(i), upper_.at(i), upper_coarse_.at(i), fraction_.at(i));
      if (left > 0) {
        // Settled cells have the layer's thickness exactly, and a stratum that is neither full nor used up.
        unsettled.clear();
        for (int row = 0; row < rows; ++row)
          if (thickness_.at(i)[row] != nominal_) {
            unsettled.push_back(row);
            bed_.strata.fetch(cell(i, row));
          }
        for (const int row : unsettled) {
          settle_cell(i, row);
          fraction_.at(i)[row] = coarse_part(coarse_.at(i)[row], nominal_);
        }
      }
      fraction_.fill_pads(i, frame_.periodic());
      widen_maximum(rows, fraction_.at(i), most.data());
    }
    coarsest[static_cast<std::size_t>(block)] = *std::max_element(most.begin(), most.end());
  });
  coarsest_ = *std::max_element(coarsest.begin(), coarsest.end());
}

void ActiveLayer::leave() {
  frame_.leave(coarse_, bed_.coarse);
  frame_.leave(upper_, bed_.upper);
  frame_.leave(upper_coarse_, bed_.upper_coarse);
}

}  // namespace aeolian
