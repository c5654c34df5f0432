#include "aeolian_core/bedforms/height_map/wind_frame.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace aeolian {

WindFrame::WindFrame(const GridGeometry& geometry, double direction, bool periodic)
    : cells_{0, geometry.nx(), 0, geometry.ny()}, nx_(geometry.nx()), periodic_(periodic) {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  transposed_ = std::abs(s) > std::abs(c);
  const double along = transposed_ ? s : c;
  const double across = transposed_ ? c : s;
  reversed_ = along < 0;
  stations_ = transposed_ ? geometry.ny() : geometry.nx();
  rows_ = transposed_ ? geometry.nx() : geometry.ny();

  drift_ = across / std::abs(along);
  if (periodic_) drift_ = std::round(drift_ * stations_) / stations_;
  // A drift of less than a thousandth of a row over the grid is none; lines then lie on rows exactly.
  if (std::abs(drift_) * stations_ < 1e-3) drift_ = 0;
  step_ = geometry.cell() * std::hypot(1, drift_);
  find_places();
  for (const Place& place : places_) blur_ += place.upper * (1 - place.upper) / stations_;
}

void WindFrame::find_places() {
  places_.clear();
  for (int i = 0; i < stations_; ++i) places_.push_back(computed_place(i));
  const int last = places_.back().offset;
  first_line_ = periodic_ ? 0 : -std::max(1, last);
  end_line_ = periodic_ ? rows_ : rows_ + 1 - std::min(1, last);
}

WindFrame WindFrame::part(const CellRange& wanted) const {
  WindFrame result = *this;
  CellRange& cells = result.cells_;
  cells = wanted;
  // Begins where a patch of the whole does.
  const auto round = [](int low, int& at) { at = low + (at - low) / alignment * alignment; };
  const auto round_high = [](int high, int& at) { at = high - (high - at) / alignment * alignment; };
  if (reversed_ && transposed_)
    round_high(cells_.y1, cells.y1);
  else
    round(cells_.y0, cells.y0);
  if (reversed_ && !transposed_)
    round_high(cells_.x1, cells.x1);
  else
    round(cells_.x0, cells.x0);
  const int before_x = cells.x0 - cells_.x0;
  const int behind_x = cells_.x1 - cells.x1;
  const int before_y = cells.y0 - cells_.y0;
  const int behind_y = cells_.y1 - cells.y1;
  const int low = transposed_ ? before_y : before_x;
  const int high = transposed_ ? behind_y : behind_x;
  const int upwind = reversed_ ? high : low;
  result.stations_ = stations_ - low - high;
  result.rows_ = rows_ - (transposed_ ? before_x + behind_x : before_y + behind_y);
  result.rim_ = {upwind > 0, (reversed_ ? low : high) > 0, (transposed_ ? before_x : before_y) > 0,
                 (transposed_ ? behind_x : behind_y) > 0};
  const double shift = phase_ + drift_ * upwind;
  result.phase_ = shift - std::floor(shift + 1e-9);
  result.find_places();
  return result;
}

WindFrame::Place WindFrame::computed_place(int station) const {
  // Half a row's shift makes q - 1 the row of line 0 at station 0, with nothing in row q.
  const double at = 1 + phase_ + drift_ * station;
  const double row = std::floor(at + 1e-9);
  return {static_cast<int>(row), std::max(0.0, at - row)};
}

int WindFrame::longest_way() const {
  if (!periodic_) return stations_;
  const int moved = computed_place(stations_).offset - computed_place(0).offset;
  return stations_ * (rows_ / std::gcd(rows_, moved));
}

/// Calls work(station, row, the cell's index in the grid), by blocks that fit the cache both ways, in
/// parallel.
template <class Work>
void WindFrame::for_cells(Work&& work) const {
  constexpr int block = 16;
  const auto nx = static_cast<std::size_t>(nx_);
  const int first_station = transposed_ ? cells_.y0 : cells_.x0;
  const int first_row = transposed_ ? cells_.x0 : cells_.y0;
  tbb::parallel_for(0, (stations_ + block - 1) / block, [&](int n) {
    const int from = n * block;
    for (int row_from = 0; row_from < rows_; row_from += block)
      for (int i = from; i < std::min(from + block, stations_); ++i) {
        const auto along = static_cast<std::size_t>(first_station + (reversed_ ? stations_ - 1 - i : i));
        for (int row = row_from; row < std::min(row_from + block, rows_); ++row) {
          const auto across = static_cast<std::size_t>(first_row + row);
          work(i, row, transposed_ ? along * nx + across : across * nx + along);
        }
      }
  });
}

void WindFrame::enter(const std::vector<double>& grid, FrameField& frame) const {
  frame = FrameField::unset(stations_, rows_);
  for_cells([&](int station, int row, std::size_t cell) { frame.at(station)[row] = grid[cell]; });
  for (int i = 0; i < stations_; ++i) frame.fill_pads(i, periodic_);
}

void WindFrame::leave(const FrameField& frame, std::vector<double>& grid) const {
  for_cells([&](int station, int row, std::size_t cell) { grid[cell] = frame.at(station)[row]; });
}

}  // namespace aeolian
