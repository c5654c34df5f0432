#pragma once

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// No grain rebounds: the bed keeps the one that hits, or a grain of its own leaves instead.
class NoRebound : public Rebound {
 public:
  std::optional<LeavingGrain> sample(const Impact&, RandomStream&) const override { return std::nullopt; }
};

/// Ejecta of Ungar & Haff (1987): all leave straight away from the bed at one speed, and their number grows
/// as the energy of the impact, `coefficient` v^2 / (g d), in whole numbers of this mean. Against Werner's
/// experiments, where the number grows as the speed; for the analytic limit of saltation only.
class UngarHaffEjection : public Ejection {
 public:
  /// Speed over sqrt(g d). The defaults give number and mean speed of case 4 of the thesis' eq. 4.34, whose
  /// grain has 0.25 mm. Throws Error for a grain that check() refuses and numbers that are not positive.
  explicit UngarHaffEjection(const Grain& grain, double coefficient = 3.924e-4, double speed = 16.15);
  double mean_number(const Impact& impact) const override;
  void sample(const Impact& impact, RandomStream& random, std::vector<LeavingGrain>& ejecta) const override;

 private:
  double unit_;  ///< sqrt(g d) [m/s]
  double coefficient_, speed_;
};

}  // namespace aeolian
