#pragma once

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// Rebound of Kok & Renno (2009, sec. 2.3.2; COMSALT): with probability 0.96 (1 - exp(-v / (1 m/s))) the
/// grain keeps 45 +- 22 % of its energy (normal, kept from 1 to 99.9 %) and leaves at an elevation above the
/// bed that is exponential with mean 40 degrees. For sand at any angle of impact, which does not enter.
class KokRennoRebound : public Rebound {
 public:
  std::optional<LeavingGrain> sample(const Impact& impact, RandomStream& random) const override;
};

/// Ejecta of Kok & Renno (2009, sec. 2.3.3; COMSALT): a (v / sqrt(g d)) times the size ratio, a = 0.02, drawn
/// by Poisson; speeds exponential with mean (0.15 / 0.02) (1 - exp(-v / (40 sqrt(g d)))) sqrt(g d),
/// elevations exponential with mean 50 degrees. Fitted to sand of 0.1 to 1 mm at impacts up to some 5 m/s
/// near 10 degrees.
class KokRennoEjection : public Ejection {
 public:
  explicit KokRennoEjection(const Grain& grain);
  double mean_number(const Impact& impact) const override;
  void sample(const Impact& impact, RandomStream& random, std::vector<LeavingGrain>& ejecta) const override;
  double mean_speed(double impact_speed) const;  ///< [m/s]

 private:
  double unit_;  ///< sqrt(g d) [m/s]
};

}  // namespace aeolian
