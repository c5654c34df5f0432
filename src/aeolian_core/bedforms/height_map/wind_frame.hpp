#pragma once

#include <algorithm>
#include <vector>

#include "aeolian_core/bedforms/height_map/frame_field.hpp"
#include "aeolian_core/bedforms/wrapped.hpp"
#include "aeolian_core/surface/grid_geometry.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// A grid turned by quarter turns and mirrored so that the wind blows within 45 degrees of its first axis,
/// and the lines along the wind that cover it.
///
/// In the frame a cell is (station, row): stations count downwind along the grid axis nearest to the wind,
/// rows across. Line j visits every station once; at a station it lies between rows q - 1 and q, where q = j
/// + offset, with the share `upper` in the latter. It drifts across by `drift` rows per station, alike for
/// all lines.
class WindFrame {
 public:
  /// `periodic` rounds the drift so that lines close after one period.
  WindFrame(const GridGeometry& geometry, double direction, bool periodic);

  /// The frame of a part of an open grid, whose lines lie where those of the whole do. The part is taken
  /// wider, to begin at a multiple of `alignment` stations and rows of the whole.
  static constexpr int alignment = 32;
  WindFrame part(const CellRange& cells) const;

  /// On which sides of a part the grid goes on.
  struct Rim {
    bool upwind = false, downwind = false, low_rows = false, high_rows = false;
    bool any() const { return upwind || downwind || low_rows || high_rows; }
  };
  const Rim& rim() const { return rim_; }

  int stations() const { return stations_; }
  int rows() const { return rows_; }
  bool periodic() const { return periodic_; }
  /// Rows by which lines move across per station, -1 to 1: the tangent of the wind's angle to the first axis.
  double drift() const { return drift_; }
  /// Length along the wind from one station to the next [m].
  double step() const { return step_; }
  /// What the blend of two rows takes from a wave across them, gathering or scattering: mean of upper (1 -
  /// upper).
  double blur() const { return blur_; }

  struct Place {
    int offset;
    double upper;
  };
  /// Where the lines lie at a station, which may be off the grid.
  Place place(int station) const {
    if (station >= 0 && station < stations_) return places_[static_cast<std::size_t>(station)];
    return computed_place(station);
  }

  /// Stations after which a line has been everywhere that it goes: on a periodic grid it may have to go round
  /// several times until it meets itself.
  int longest_way() const;

  /// Lines that have part in the grid: first_line() <= j < end_line().
  int first_line() const { return first_line_; }
  int end_line() const { return end_line_; }

  struct LineRange {
    int begin, end;
  };
  /// Lines that are on an open grid at a station; beyond it, at its nearest station.
  LineRange lines_at(int station) const {
    const int offset = place(std::clamp(station, 0, stations_ - 1)).offset;
    return {-offset, rows_ + 1 - offset};
  }
  /// Calls visit(line) for those of the lines [begin, end) that are on an open grid at one station and not at
  /// the other.
  template <class Visit>
  void for_difference(int station, int other, LineRange lines, Visit&& visit) const {
    const LineRange with = lines_at(station);
    const LineRange without = lines_at(other);
    if (with.begin == without.begin) return;
    for (int j = std::max(with.begin, lines.begin); j < std::min({with.end, without.begin, lines.end}); ++j)
      visit(j);
    for (int j = std::max({with.begin, without.end, lines.begin}); j < std::min(with.end, lines.end); ++j)
      visit(j);
  }
  /// Calls work(begin, end, q of the line `begin`) for the stretches of given lines that lie side by side at
  /// a station: a periodic grid ends where it begins.
  template <class Work>
  void for_stretches(int station, LineRange lines, Work&& work) const {
    const int offset = place(station).offset;
    if (!periodic_) return work(lines.begin, lines.end, lines.begin + offset);
    while (lines.begin < lines.end) {
      const int q = wrapped(lines.begin + offset, rows_);
      const int count = std::min(lines.end - lines.begin, rows_ - q);
      work(lines.begin, lines.begin + count, q);
      lines.begin += count;
    }
  }

  /// Copies a grid's values (x fastest; of a part those of the whole grid) into the frame and back. The grid
  /// has its size in both.
  void enter(const std::vector<double>& grid, FrameField& frame) const;
  void leave(const FrameField& frame, std::vector<double>& grid) const;

 private:
  Place computed_place(int station) const;
  void find_places();
  template <class Work>
  void for_cells(Work&& work) const;

  CellRange cells_;  ///< of the grid
  int nx_;           ///< of the whole grid
  Rim rim_;
  double phase_ = 0;  ///< shift of the lines across, below a row
  int stations_;
  int rows_;
  bool transposed_;
  bool reversed_;
  bool periodic_;
  double drift_ = 0;
  double step_ = 0;
  double blur_ = 0;
  std::vector<Place> places_;  ///< at the stations of the grid
  int first_line_ = 0;
  int end_line_ = 0;
};

}  // namespace aeolian
