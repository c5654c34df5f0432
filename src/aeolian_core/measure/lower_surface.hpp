#pragma once

#include <cstdint>

#include "aeolian_core/measure/fixed_point.hpp"

namespace aeolian {

/// How far from a surface a point may lie and still be of it: squared distance [m^2] at most
/// squared_gate variance(point) + relief^2.
struct SurfaceGate {
  double squared_gate = 16;
  /// Half the height that a bed at the angle of repose spans within a cell [m].
  double relief = 0;
  /// Weight times variance of a point [m^2].
  double weight_scale = fixed::reference_weight * 1e-6;

  double squared_reach(std::uint32_t weight) const {
    return squared_gate * weight_scale / weight + relief * relief;
  }
};

/// Samples of one surface, summed in whole numbers about a datum.
struct SurfaceSum {
  std::int32_t datum = 0;   ///< [steps]
  std::uint32_t count = 0;  ///< samples
  double weight = 0;        ///< sum of weights
  double moment = 0;        ///< sum of weight x (height - datum) [steps]

  void add(Sample sample) {
    ++count;
    weight += sample.weight();
    moment += sample.weight() * static_cast<double>(std::int64_t{sample.height()} - datum);
  }
  double height() const { return fixed::metres(datum) + fixed::step * moment / weight; }  ///< [m]
};

/// All of some samples.
SurfaceSum whole_surface(const Sample* begin, const Sample* end);

/// Those of some samples of one cell, sorted, that belong to its lowest surface: the lowest window of the
/// gate's width that holds at least 0.3 times as many samples as the fullest, then those within the gate
/// about their mean. Grains in flight, plants and roofs above are left out, and so are stray points far
/// below.
SurfaceSum lower_surface(const Sample* begin, const Sample* end, const SurfaceGate& gate);

}  // namespace aeolian
