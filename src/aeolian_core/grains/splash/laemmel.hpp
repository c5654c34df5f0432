#pragma once

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// Material of Laemmel, Dzikowski & Kroy (2017): restitutions of two grains, normal and tangential. The
/// defaults are their fits to sand and beads.
struct LaemmelParameters {
  double normal = 0.7;        ///< epsilon, above 0, to 1
  double tangential = -0.15;  ///< nu, -1 to 1

  /// Throws Error naming the parameter, its value and what is allowed.
  void require_valid() const;
};

/// Rebound of Laemmel et al. (2017): a sphere off a bed of spheres, to first order in the angle, so for 5 to
/// 40 degrees. The speed is the mean one, e = beta - (beta^2 - alpha^2) d2 angle / (2 beta), each time; the
/// elevation has their distribution, and grains that it sends down stay. Any size ratio.
class LaemmelRebound : public Rebound {
 public:
  explicit LaemmelRebound(const LaemmelParameters& parameters = {});
  std::optional<LeavingGrain> sample(const Impact& impact, RandomStream& random) const override;
  double restitution(double angle, double size_ratio) const;  ///< of the speed, not below zero

 private:
  LaemmelParameters parameters_;
};

/// Ejecta of Laemmel et al. (2017) after Ho et al. (2012): what energy the rebound leaves is split among the
/// bed's grains to a log-normal distribution, 0.06 of it into grains that may rise; those rise that get more
/// than m g d. The number is drawn by Poisson. Elevations are Kok & Renno's (2009), exponential with mean 50
/// degrees: the energy says nothing of them.
class LaemmelEjection : public Ejection {
 public:
  explicit LaemmelEjection(const Grain& grain, const LaemmelParameters& parameters = {});
  double mean_number(const Impact& impact) const override;
  double mean_speed(const Impact& impact) const;  ///< of ejected grains [m/s]
  void sample(const Impact& impact, RandomStream& random, std::vector<LeavingGrain>& ejecta) const override;

 private:
  /// Of the energies over m g d; a width of zero: nothing rises.
  struct Energies {
    double middle, width, number;
  };
  Energies energies(const Impact& impact) const;

  LaemmelRebound rebound_;
  double unit2_;  ///< g d [m^2/s^2]
};

}  // namespace aeolian
