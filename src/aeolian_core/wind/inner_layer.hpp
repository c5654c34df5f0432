#pragma once

#include <complex>

#include "aeolian_core/surface/grid_geometry.hpp"
#include "aeolian_core/wind/upwind_profile.hpp"

namespace aeolian {

/// Linear theory of the wind over one wave of relief (Jackson & Hunt 1975; Hunt, Leibovich & Richards 1988;
/// Weng et al. 1991), whose length is L = 1/k: each wave has its own layers, as in MS3DJH.

/// Depth l of the inner layer, in which friction matters: l ln(l/z0) = 2 kappa^2 L (Jackson & Hunt) [m].
double inner_depth(double length, double roughness);
/// That of the longest slopes of a map, whose relief is not asked: a quarter of its shorter side is a long
/// hill on it [m].
double inner_depth_over(const GridGeometry& map, double roughness);
/// Height h_m above which shear does not matter: h_m sqrt(ln(h_m/z0)) = L [m].
double middle_height(double length, double roughness);

/// What a wave of unit amplitude [m] does, `along` and `across` the wind; complex, as the answer is shifted
/// against the wave.
struct WaveResponse {
  std::complex<double> along;
  std::complex<double> across;
};

/// One wave: wave number k > 0 [1/m] and the cosine and sine of the angle from the wind to its vector.
class ReliefWave {
 public:
  ReliefWave(const UpwindProfile& upwind, double wave_number, double cosine, double sine);

  /// Of the surface stress, relative to that of flat ground. `along` is Weng's (1991)
  /// k_x^2/k 2/U^2 (-1 + (2 ln(l/z0) + k^2/k_x^2) s K1(2s)/K0(2s)), U = ln(l/z0)/ln(h_m/z0),
  /// s = sqrt(i k_x z0/(4 k l)); `across` is the same balance of pressure and friction for the velocity
  /// across, whose eddy viscosity is half: k_x k_y/k 1/U^2 (-1 + 2 ln(l/z0) S K1(2S)/K0(2S)), S^2 = 2 s^2: to
  /// leading order the stress turns as far as the wind does.
  /// Only over a log law.
  WaveResponse stress() const;
  /// Of the velocity at a height over the ground [m], in units of the upwind profile. Its shear at the ground
  /// gives stress(); aloft it is potential flow, u = k_x^2/k exp(-k z), as it is at all heights where the
  /// wind has no shear.
  WaveResponse velocity(double height) const;

 private:
  const UpwindProfile& upwind_;
  double k_;
  double cosine_;
  double sine_;
  double inner_ = 0;
  double middle_ = 0;
  double log_inner_ = 0;           ///< ln(l/z0)
  double gain_ = 1;                ///< 1/U^2
  std::complex<double> friction_;  ///< s^2
};

}  // namespace aeolian
