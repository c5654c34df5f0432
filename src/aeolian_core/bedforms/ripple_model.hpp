#pragma once

#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"

namespace aeolian {

enum class Border {
  periodic,  ///< opposite borders are joined; needs a fully known map
  open,      ///< flat-bed supply from upwind, free outflow downwind
};

struct RippleParameters {
  Border border = Border::open;
  /// mu, the downslope bias of reptation (specification sec. 5.4), below cot(impact angle). Of 0.5 to 3, 1 forecasts the
  /// lattice bed best five minutes ahead.
  double slope_effect = 1.0;
  double lateral_spread = 0.25;  ///< standard deviation of a hop across the wind / mean reptation length
  double relief_scale = 0.5;     ///< heights are taken above the surface smoothed over this length [m]
};

/// Ripples on a height map: impacts at a grazing angle fall on exposed slopes only, each sets grains
/// reptating with an exponential distribution of lengths, slopes feed back on reptation, and what is steeper
/// than repose avalanches. dh/dt = deposition - erosion - div q (specification sec. 5.4, after Werner 1987,
/// eqs. 5.3-5.6).
///
/// Linear theory on a flat bed: wavelength 2 pi a / sqrt(sqrt(cot alpha / mu) - 1), growth rate
/// (K0 / a) (sqrt(cot alpha) - sqrt(mu))^2. The model picks its own time steps.
class RippleModel : public BedModel {
 public:
  /// Throws Error naming a parameter outside its range.
  explicit RippleModel(const RippleParameters& parameters);
  BedChange advance(HeightMap& map, const Forcing& forcing, double duration) override;

  /// The same on heights in double, for a run that must keep volume to rounding over many calls. Every cell
  /// known.
  BedChange advance(const GridGeometry& geometry, std::vector<double>& height, const Forcing& forcing,
                    double duration);

 private:
  RippleParameters parameters_;
};

}  // namespace aeolian
