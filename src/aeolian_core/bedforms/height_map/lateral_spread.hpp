#pragma once

#include <vector>

#include "aeolian_core/bedforms/height_map/wind_frame.hpp"

namespace aeolian {

/// Spreads what comes down across the wind, whatever its angle to the grid: a nearly Gaussian kernel over
/// rows whose taps lie on the perpendicular to the wind, between stations by second-order interpolation. The
/// sum is conserved to rounding, what is positive stays so, and open borders are walls.
class LateralSpread {
 public:
  /// `sigma`: the standard deviation across the wind, in cells.
  LateralSpread(const WindFrame& frame, double sigma);

  /// Stations upwind and downwind of a result that have part in it.
  int reach() const { return frame_.drift() == 0 ? 0 : passes_; }
  /// Rows that a value may reach.
  int reach_across() const { return passes_ * static_cast<int>(weight_.size()); }

  class Stream;

 private:
  const WindFrame& frame_;
  int passes_ = 0;
  std::vector<double> weight_;  ///< of the taps 0, 1, ... rows away, in one pass
};

/// Spreads the stations [begin, end), which may lie beyond a periodic grid, one after the other; only rows
/// [row_begin, row_end) are worked on, others are taken as zero. Nothing is spread to or from where `open`,
/// the field of the whole frame or null, is zero.
class LateralSpread::Stream {
 public:
  Stream(const LateralSpread& spread, int begin, int end, int row_begin, int row_end, const FrameField* open);

  /// Row 0 of the values of the next station, to be filled in.
  double* next() { return rows_.at(0); }

  /// Takes them in. Calls emit(station, row 0 of its spread values) for each station that is complete by now:
  /// all but the first and last `reach()` where the stretch does not end at a wall.
  template <class Emit>
  void push(Emit&& emit) {
    push(0, next_++, emit);
  }

 private:
  template <class Emit>
  void push(int pass, int station, Emit& emit) {
    if (pass == spread_.passes_) {
      emit(station, static_cast<const double*>(rows_.at(pass)));
      return;
    }
    fold(pass, station);
    if (spread_.frame_.drift() == 0) return push(pass + 1, station, emit);
    const int earliest = wall_before_ ? begin_ : begin_ + pass;
    if (station > earliest) {
      flow(pass, station - 1);
      if (station - 1 > earliest || wall_before_) {
        add_up(pass, station - 1);
        push(pass + 1, station - 1, emit);
      }
    }
    if (station == end_ - 1 && wall_behind_) {
      close(pass, station);
      add_up(pass, station);
      push(pass + 1, station, emit);
    }
  }

  enum Moment { sum, first, second, flux };  ///< of weight times 1, distance, its square; to the next station
  double* moment(int pass, Moment which, int station) {
    return moments_.at((pass * 4 + which) * 3 + (station - begin_ + 3) % 3) + row_begin_;
  }
  const double* open_at(int station) const;
  void fold(int pass, int station);
  void flow(int pass, int station);
  void close(int pass, int station);
  void add_up(int pass, int station);

  const LateralSpread& spread_;
  int begin_, end_, next_;
  int row_begin_, row_end_;
  const FrameField* open_;
  bool wall_before_, wall_behind_;
  FrameField rows_;     ///< what each pass takes in, and the result
  FrameField moments_;  ///< of each pass at three stations in turn
};

}  // namespace aeolian
