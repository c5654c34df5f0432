#pragma once

#include <optional>
#include <vector>

#include "aeolian_core/bedforms/height_map/avalanche.hpp"
#include "aeolian_core/bedforms/height_map/impact_angles.hpp"
#include "aeolian_core/bedforms/height_map/impact_noise.hpp"
#include "aeolian_core/bedforms/height_map/lateral_spread.hpp"
#include "aeolian_core/bedforms/height_map/long_wave_flux.hpp"
#include "aeolian_core/bedforms/height_map/ripple_growth.hpp"
#include "aeolian_core/bedforms/height_map/ripple_model.hpp"
#include "aeolian_core/bedforms/height_map/sand_reach.hpp"
#include "aeolian_core/bedforms/height_map/slope_flux.hpp"

namespace aeolian {

/// What does not change of a whole grid while its heights do.
struct RippleSetting {
  const RippleParameters& parameters;
  const Forcing& forcing;
  double cell;                       ///< [m]
  const std::vector<double>& dune;   ///< the surface above which heights count [m]
  const std::vector<double>* floor;  ///< as in HardGround, null where there is none
  const std::vector<double>* open;
  bool holes;  ///< whether `open` is zero anywhere
};

/// Rows aside of sand that its motion within a step may reach or depend on.
int reach_aside(const RippleParameters& parameters, const Forcing& forcing, const WindFrame& frame,
                double cell);

/// A bed, or a part of it, under one forcing while RippleModel moves it forward, step by step. What is too
/// steep at the beginning slides first.
class RippleMotion {
 public:
  /// Heights [m] of the whole grid; the frame may be that of a part. The setting outlives this.
  RippleMotion(const RippleSetting& setting, const WindFrame& frame, const std::vector<double>& height);

  /// The longest stable step [s].
  double longest_step() const;

  /// Whether sand may leave this part of the grid in the next step.
  bool may_leave(const SandReach& reach);

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
  ImpactAngles angles_;
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
