#pragma once

#include <cstddef>
#include <vector>

#include "aeolian_core/surface/grid_geometry.hpp"

namespace aeolian {

/// A grid turned by quarter turns and mirrored so that the wind blows within 45 degrees of its first axis,
/// and the lines along the wind that cover it.
///
/// In the frame a cell is (station, row): stations count downwind along the grid axis nearest to the wind,
/// rows across; index = row * stations + station. A line visits every station once and drifts across by
/// `drift` rows per station; between two rows a value is shared by both, in proportion.
class WindFrame {
 public:
  /// `periodic` rounds the drift so that lines close: line j of one period goes on as line j + turn of the
  /// next.
  WindFrame(const GridGeometry& geometry, double direction, bool periodic);

  std::size_t stations() const { return stations_; }
  std::size_t rows() const { return rows_; }
  bool periodic() const { return periodic_; }
  /// Length along the wind from one station to the next [m].
  double step() const { return step_; }

  /// One line's place at a station: between row `row` and `row + 1`, with the share `upper` in the latter.
  struct Place {
    int row;
    double upper;
  };
  /// Place of line 0 at each station; line j is j rows further.
  const std::vector<Place>& places() const { return places_; }
  /// Lines that cover the grid: rows() when periodic, else from first_line() so many that every cell is on
  /// two of them.
  int first_line() const { return first_line_; }
  int lines() const { return lines_; }
  /// Rows by which a periodic line is displaced after one period.
  int turn() const { return turn_; }

  /// Copies a grid's values (x fastest) into the frame and back.
  void enter(const std::vector<double>& grid, std::vector<double>& frame) const;
  void leave(const std::vector<double>& frame, std::vector<double>& grid) const;

 private:
  template <class Visit>
  void for_each_pair(Visit&& visit) const;

  std::size_t stations_;
  std::size_t rows_;
  bool transposed_;
  bool reversed_;
  bool periodic_;
  double step_ = 0;
  std::vector<Place> places_;
  int first_line_ = 0;
  int lines_ = 0;
  int turn_ = 0;
};

}  // namespace aeolian
