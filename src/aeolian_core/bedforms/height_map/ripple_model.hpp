#pragma once

#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/height_map/border_supply.hpp"
#include "aeolian_core/bedforms/height_map/wavelength_law.hpp"

namespace aeolian {

class RippleMotion;
class SandReach;

enum class Border {
  periodic,  ///< opposite borders are joined; needs a fully known map
  open,      ///< supply from upwind, free outflow downwind
};

struct RippleParameters {
  Border border = Border::open;
  Inflow inflow = Inflow::flat_bed;  ///< over open borders from upwind
  double supply = 1;                 ///< what comes in so, as a share of that
  /// nu: hops end early by this share of the rise of the bed over the hop, late by that of its fall.
  /// Reptating grains come down at about 37 degrees (ejecta rise at 0.5 m/s and land at 0.45 down, 0.6
  /// along): 1.33; less 0.3, because a struck slope lets go of its topmost grain, as measured on the lattice
  /// bed.
  double hop_shortening = 1.0;
  /// mu, the downslope bias of grains that have come down (specification sec. 5.4). Ripples grow only while
  /// hop_shortening + slope_effect < cot(impact angle). 0.25 to 0.5 forecast the lattice bed best.
  double slope_effect = 0.4;
  /// Slope at which that bias has doubled [rad]; it grows with the square of the slope (see slope_bias.hpp).
  /// About 22 degrees forecast the lattice bed best; 4 degrees make ripples as flat as nature's, of index
  /// 15 to 20. A right angle leaves the bias as it is.
  double doubling_slope = 22 * M_PI / 180;
  /// Where ripples stop growing; null: nowhere. What is less than 1.4 times the wavelength that grows fastest
  /// counts as that (docs/ripple_model.md).
  std::shared_ptr<const WavelengthLaw> wavelength_law;
  double lateral_spread = 0.25;  ///< standard deviation of a hop across the wind / mean reptation length
  double relief_scale = 0.5;     ///< heights are taken above the surface smoothed over this length [m]
  /// Noise of single grains (see impact_noise.hpp): the share of the cells that draw theirs in a step, 0
  /// (none) to 1. Less than 1 keeps the variance and costs less; a run that has fewer than 1 / share steps
  /// leaves cells out.
  double stochastic_share = 0;
  std::uint64_t seed = 1;  ///< of noise and inflow; runs of one model go on with the random numbers
  /// The longest step, in the time in which a flat bed loses the depth that a falling grain sinks over one
  /// cell. Stable up to 1; docs/ripple_model.md has the error against the step.
  double step = 1;
  /// Steps are shortened until their error, estimated every 16 steps on the whole bed, is below this [m/s,
  /// RMS of the heights]; 0: never.
  double error_bound = 0;
};

/// How far a model has come; its runs go on from there.
struct RippleClock {
  double time = 0;                ///< moved forward [s]
  std::uint64_t noisy_steps = 0;  ///< that have drawn random numbers
};

/// Ripples on a height map: impacts at a grazing angle fall on exposed slopes only, each sets grains
/// reptating with an exponential distribution of lengths, slopes feed back on reptation, and what is steeper
/// than repose avalanches. The layer `ground` of a map, where it is known, is never eroded; unknown cells are
/// passed over and keep no sand. dh/dt = deposition - erosion - div q (specification sec. 5.4, after Werner
/// 1987, eqs. 5.3-5.6).
///
/// Linear theory on a flat bed, with C = cot(alpha) - nu: growth rate K0 (C k^2 a / (1 + k^2 a^2) - mu a
/// k^2), phase speed K0 C k^2 a^2 / (1 + k^2 a^2); fastest growth (K0 / a) (sqrt(C) - sqrt(mu))^2 at a
/// wavelength of 2 pi a / sqrt(sqrt(C / mu) - 1). Impact angles with a spread each have their own shadows
/// (ImpactAngles): cot(alpha) is then the mean of their cotangents, which is more than that of the mean
/// angle. The model picks its own time steps.
///
/// Such ripples merge without end. A wavelength law ends it: waves longer than ripples may be lose height by
/// long_wave_flux.hpp, calibrated so that the mean wavelength settles at the law's.
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
  BedChange advance(const GridGeometry& geometry, std::vector<double>& height,
                    const std::vector<double>* floor, const std::vector<double>* open, const Forcing& forcing,
                    double duration);

  double run(RippleMotion& motion, const SandReach& reach, double left);

  RippleParameters parameters_;
  RippleClock clock_;
};

}  // namespace aeolian
