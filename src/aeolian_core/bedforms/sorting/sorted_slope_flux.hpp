#pragma once

#include <vector>

#include "aeolian_core/bedforms/sorting/active_layer.hpp"

namespace aeolian {

/// SlopeFlux that carries the composition of the active layer that it comes from: the same heights, by the
/// same scheme, written so that the flux through each face is known.
///
/// A Runge-Kutta-Legendre scheme for dh/dt = L h gives h + T L z in the end, where z is a mean of the heights
/// on the way; z obeys the scheme's own recursion. So each stage is one of z, and the last says what flows.
class SortedSlopeFlux {
 public:
  /// `scale`: diffusivity [m^2/s] at an activity of one.
  SortedSlopeFlux(const WindFrame& frame, double cell, double scale);

  /// Lets a bed and its layer, mixed, relax for `duration` [s]. Pads of all fields filled before and after;
  /// the layer is mixed again.
  void run(const FrameField& activity, double strongest_activity, double duration, FrameField& height,
           ActiveLayer& layer);

 private:
  template <class Work>
  void for_stations(Work&& work) const;
  const FrameField& mean_heights(const FrameField& activity, double stages, double gain,
                                 const FrameField& height);

  const WindFrame& frame_;
  double cell_;
  double scale_;
  FrameField first_, second_, change_, coarse_change_;
};

}  // namespace aeolian
