#include "aeolian_core/bedforms/wind_frame.hpp"

#include <cmath>

namespace aeolian {

WindFrame::WindFrame(const GridGeometry& geometry, double direction, bool periodic) : periodic_(periodic) {
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  transposed_ = std::abs(s) > std::abs(c);
  const double along = transposed_ ? s : c;
  const double across = transposed_ ? c : s;
  reversed_ = along < 0;
  stations_ = static_cast<std::size_t>(transposed_ ? geometry.ny() : geometry.nx());
  rows_ = static_cast<std::size_t>(transposed_ ? geometry.nx() : geometry.ny());

  const auto count = static_cast<double>(stations_);
  double drift = across / std::abs(along);
  if (periodic_) {
    turn_ = static_cast<int>(std::lround(drift * count));
    drift = turn_ / count;
  }
  step_ = geometry.cell() * std::hypot(1, drift);
  for (std::size_t i = 0; i < stations_; ++i) {
    const double at = drift * static_cast<double>(i);
    const double row = std::floor(at);
    places_.push_back({static_cast<int>(row), at - row});
  }
  if (periodic_) {
    lines_ = static_cast<int>(rows_);
  } else {
    const int last = places_.back().row;
    first_line_ = -1 - std::max(0, last);
    lines_ = static_cast<int>(rows_) + 1 + std::abs(last);
  }
}

template <class Visit>
void WindFrame::for_each_pair(Visit&& visit) const {
  for (std::size_t row = 0; row < rows_; ++row)
    for (std::size_t i = 0; i < stations_; ++i) {
      const std::size_t along = reversed_ ? stations_ - 1 - i : i;
      visit(row * stations_ + i, transposed_ ? along * rows_ + row : row * stations_ + along);
    }
}

void WindFrame::enter(const std::vector<double>& grid, std::vector<double>& frame) const {
  frame.resize(grid.size());
  for_each_pair([&](std::size_t in_frame, std::size_t in_grid) { frame[in_frame] = grid[in_grid]; });
}

void WindFrame::leave(const std::vector<double>& frame, std::vector<double>& grid) const {
  grid.resize(frame.size());
  for_each_pair([&](std::size_t in_frame, std::size_t in_grid) { grid[in_grid] = frame[in_frame]; });
}

}  // namespace aeolian
