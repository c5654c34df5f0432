#pragma once

#include "aeolian_core/bedforms/height_map/hard_ground.hpp"

namespace aeolian {

/// Moves sand from what is high to what is low on scales beyond ripples: q = -D grad S(h - dune), where S
/// smooths with nearly a Gaussian of standard deviation wavelength / pi. A wave of wave number k decays at
/// the rate D k^2 exp(-k^2 wavelength^2 / (2 pi^2)), most at 1.4 times the wavelength; waves of 0.6 times the
/// wavelength and shorter are left alone. Volume is conserved to rounding; open borders are walls.
///
/// Empirical: it stands for the wind, which strips what stands out into it. It stops mergers, in which two
/// ripples become a wave of twice their length.
class LongWaveFlux {
 public:
  /// `wavelength` [m], `diffusivity` D [m^2/s].
  LongWaveFlux(const WindFrame& frame, double cell, double wavelength, double diffusivity);

  /// Cells over which the flux of such a wavelength smooths.
  static int reach(double wavelength, double cell);

  /// The fastest rate at which any wave decays [1/s].
  double rate() const { return rate_; }

  /// Acts for `duration` [s] on heights [m] with pads filled, before and after. On hard ground (null: none)
  /// sand moves among active patches, and no more than lies there.
  void run(const FrameField& dune, double duration, const HardGround* ground, const ActivePatches& active,
           FrameField& bed);

 private:
  void smooth(const FrameField& dune, const FrameField& bed);
  void smooth_across();
  void smooth_along();
  void move(double gain, const HardGround* ground, const ActivePatches& active, FrameField& bed);

  const WindFrame& frame_;
  double cell_;
  double diffusivity_;
  double rate_;
  int half_along_, half_across_;  ///< of the running means, in cells
  FrameField smooth_, sums_;
};

}  // namespace aeolian
