#pragma once

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// Mean restitutions of Beladjine et al. (2007): beads of 6 mm at 18 to 39 m/s and 10 to 90 degrees.
/// @{
double beladjine_restitution(double angle);           ///< e = 0.87 - 0.72 sin(angle), of the speed
double beladjine_vertical_restitution(double angle);  ///< e_z = 0.30 / sin(angle) - 0.15
/// @}

/// Rebound of Beladjine et al. (2007): the mean restitutions, the same each time. The spread is not
/// tabulated, so this is to compare with, not to keep a saltation going.
class BeladjineRebound : public Rebound {
 public:
  std::optional<LeavingGrain> sample(const Impact& impact, RandomStream& random) const override;
};

/// Ejecta of Beladjine et al. (2007): 13 (1 - e^2) (v / (40 sqrt(g d)) - 1), drawn by Poisson; speeds with
/// mean 1.2 (v / sqrt(g d))^(1/4) sqrt(g d). The amplitude is that of beads; sand ejects about a third of it
/// (`amplitude` near 4.3). Speeds are drawn as exponential and elevations with mean 50 degrees, as Kok &
/// Renno (2009) do, for want of tabulated distributions.
class BeladjineEjection : public Ejection {
 public:
  /// Throws Error for a grain that check() refuses and an amplitude that is negative or not finite.
  explicit BeladjineEjection(const Grain& grain, double amplitude = 13);
  double mean_number(const Impact& impact) const override;
  double mean_speed(double impact_speed) const;  ///< [m/s]
  void sample(const Impact& impact, RandomStream& random, std::vector<LeavingGrain>& ejecta) const override;

 private:
  double unit_;  ///< sqrt(g d) [m/s]
  double amplitude_;
};

}  // namespace aeolian
