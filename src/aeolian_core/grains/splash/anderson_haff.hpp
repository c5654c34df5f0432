#pragma once

#include "aeolian_core/grains/splash/splash.hpp"

namespace aeolian {

/// Rebound of Anderson & Haff (1991): with probability 0.95 (1 - exp(-2 v)), v in m/s, at a speed that is
/// normal with mean 0.56 v and deviation 0.2 v, kept from 0 to v. The probability is that of the saltation
/// specification, sec. 7; mean and deviation are from memory of later papers: neither the original nor one
/// that prints them was found. Elevations are Kok & Renno's (2009), exponential with mean 40 degrees. Sand
/// of 0.25 mm.
class AndersonHaffRebound : public Rebound {
 public:
  std::optional<LeavingGrain> sample(const Impact& impact, RandomStream& random) const override;
};

/// Ejecta of Anderson & Haff (1991): 1.75 v, v in m/s, drawn by Poisson, of exponential speeds with mean
/// 0.25 v^0.3 m/s. From memory of later papers: neither the original nor one that prints them was found. The
/// saltation specification, sec. 7, has 0.08 v as mean speed, which is 0.24 for 0.35 m/s here at 3 m/s, and
/// as little sure. Elevations are Kok & Renno's (2009), exponential with mean 50 degrees. Sand of 0.25 mm;
/// nothing scales with its size.
class AndersonHaffEjection : public Ejection {
 public:
  double mean_number(const Impact& impact) const override { return 1.75 * impact.speed; }
  void sample(const Impact& impact, RandomStream& random, std::vector<LeavingGrain>& ejecta) const override;
};

}  // namespace aeolian
