#pragma once

#include <vector>

#include "aeolian_core/bedforms/height_map/wind_frame.hpp"

namespace aeolian {

/// The stages of a Runge-Kutta-Legendre step of diffusion (second order; Meyer, Balsara and Aslam 2014) on a
/// stretch of stations. Each stage is one station behind the one before it, so that a bed is read and written
/// once and what lies in between stays in a cache. A stage is worked out as far beyond the stretch as the
/// later ones look.
class SlopeStages {
 public:
  /// `gain` is the weight of a difference of heights, by the sum of two cells' activity. Where `deep` is not
  /// null, only cells where it is 1 exchange. Fields have their pads filled, and so has the result.
  SlopeStages(const WindFrame& frame, int count, double gain, const FrameField& activity,
              const FrameField* deep, const FrameField& height, FrameField& result);

  /// Works on the stations [begin, end) and rows [row_begin, row_end), beyond which no cell is deep.
  void run(int begin, int end, int row_begin, int row_end);

  /// Of the heights and of what flows in a stage.
  struct Weights {
    double last, before_last, start, gain, first_gain;
  };

 private:
  int wrapped(int station) const;
  const double* row(int j, int station);
  int turn(int station) const;
  void find_faces(int station);
  void run_stage(int j, int at);

  const WindFrame& frame_;
  int count_;
  const FrameField& activity_;
  const FrameField* deep_;
  const FrameField& height_;
  FrameField& result_;
  FrameField between_;  ///< four stations of each stage in turn
  int kept_;            ///< last stations of which more is kept: a power of two
  FrameField first_;    ///< what flows at first, at the last stations
  FrameField faces_;    ///< activities of faces along and across the wind, at the last stations
  double begin_gain_ = 0;
  std::vector<Weights> weights_;
  int row_begin_ = 0;
  int row_end_ = 0;
};

}  // namespace aeolian
