#include "aeolian_core/bedforms/wind_frame.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {

WindFrame::WindFrame(const GridGeometry& geometry, double direction, bool periodic) : periodic_(periodic) {
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
  for (int i = 0; i < stations_; ++i) {
    places_.push_back(computed_place(i));
    const double upper = places_.back().upper;
    blur_ += upper * (1 - upper) / stations_;
  }
  const int last = places_.back().offset;
  first_line_ = periodic_ ? 0 : -std::max(1, last);
  end_line_ = periodic_ ? rows_ : rows_ + 1 - std::min(1, last);
}

WindFrame::Place WindFrame::computed_place(int station) const {
  // Half a row's shift makes q - 1 the row of line 0 at station 0, with nothing in row q.
  const double at = 1 + drift_ * station;
  const double row = std::floor(at + 1e-9);
  return {static_cast<int>(row), std::max(0.0, at - row)};
}

void WindFrame::enter(const std::vector<double>& grid, FrameField& frame) const {
  frame = FrameField(stations_, rows_);
  const auto nx = static_cast<std::size_t>(transposed_ ? rows_ : stations_);
  constexpr int block = 16;  // turns blocks that fit the cache
  for (int from = 0; from < stations_; from += block)
    for (int row_from = 0; row_from < rows_; row_from += block)
      for (int i = from; i < std::min(from + block, stations_); ++i) {
        const auto along = static_cast<std::size_t>(reversed_ ? stations_ - 1 - i : i);
        double* const to = frame.at(i);
        for (int row = row_from; row < std::min(row_from + block, rows_); ++row) {
          const auto across = static_cast<std::size_t>(row);
          to[row] = grid[transposed_ ? along * nx + across : across * nx + along];
        }
      }
  for (int i = 0; i < stations_; ++i) frame.fill_pads(i, periodic_);
}

void WindFrame::leave(const FrameField& frame, std::vector<double>& grid) const {
  grid.resize(static_cast<std::size_t>(stations_) * static_cast<std::size_t>(rows_));
  const auto nx = static_cast<std::size_t>(transposed_ ? rows_ : stations_);
  constexpr int block = 16;
  for (int from = 0; from < stations_; from += block)
    for (int row_from = 0; row_from < rows_; row_from += block)
      for (int i = from; i < std::min(from + block, stations_); ++i) {
        const auto along = static_cast<std::size_t>(reversed_ ? stations_ - 1 - i : i);
        const double* const values = frame.at(i);
        for (int row = row_from; row < std::min(row_from + block, rows_); ++row) {
          const auto across = static_cast<std::size_t>(row);
          grid[transposed_ ? along * nx + across : across * nx + along] = values[row];
        }
      }
}

}  // namespace aeolian
