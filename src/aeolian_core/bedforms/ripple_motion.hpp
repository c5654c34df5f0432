#pragma once

#include <optional>
#include <vector>

#include "aeolian_core/bedforms/avalanche.hpp"
#include "aeolian_core/bedforms/impact_noise.hpp"
#include "aeolian_core/bedforms/lateral_spread.hpp"
#include "aeolian_core/bedforms/long_wave_flux.hpp"
#include "aeolian_core/bedforms/ripple_growth.hpp"
#include "aeolian_core/bedforms/ripple_model.hpp"
#include "aeolian_core/bedforms/slope_flux.hpp"

namespace aeolian {

/// A bed under one forcing while RippleModel moves it forward, step by step.
class RippleMotion {
 public:
  /// `floor` and `open` as in HardGround, null where there is none.
  RippleMotion(const RippleParameters& parameters, const GridGeometry& geometry,
               const std::vector<double>& height, const std::vector<double>* floor,
               const std::vector<double>* open, const Forcing& forcing);

  /// The longest stable step [s].
  double longest_step() const;

  /// One step of dt [s].
  void step(double dt, RippleClock& clock);

  /// The same in two halves. Returns the RMS difference to a whole step [m], the error of the former if
  /// errors are of first order in time.
  double step_and_compare(double dt, RippleClock& clock);

  /// Ends a run: what acts less often than each step acts for what is left.
  void finish();

  void leave(std::vector<double>& height) const { frame_.leave(state_.bed, height); }
  /// Without the bed's change.
  const VolumeBalance& volume() const { return state_.volume; }

 private:
  struct State {
    FrameField bed;
    ActivePatches active, sandy;
    VolumeBalance volume;
    double unsaturated = 0;  ///< time in which long waves have grown freely [s]
  };

  void move(double dt, double time);
  void draw_noise(double dt, RippleClock& clock);
  const HardGround* hard() const { return ground_.any() ? &ground_ : nullptr; }

  const RippleParameters& parameters_;
  const Forcing& forcing_;
  double cell_;
  FastestGrowth growth_;
  WindFrame frame_;
  ImpactSweep impacts_;
  SlopeFlux slopes_;
  Avalanches avalanches_;
  LateralSpread spread_;
  std::optional<ImpactNoise> noise_;
  std::optional<LongWaveFlux> saturation_;
  FrameField dune_, activity_;
  HardGround ground_;
  State state_;
};

}  // namespace aeolian
