#pragma once

#include "aeolian_core/grains/grain.hpp"

namespace aeolian {

/// The mean effect of saltating grains on the bed that they hit.
struct MeanSplash {
  double ejecta_coefficient = 0.02;  ///< N_e = coefficient v / sqrt(g d) (Kok & Renno 2009, eq. 12)
  double reptation_diameters = 25;   ///< mean reptation length in grain diameters

  /// Mean number of grains that an impact at `speed` [m/s] ejects.
  double ejecta_per_impact(const Grain& grain, double speed) const;
  /// Mean length of a reptation hop [m]. Hardly depends on the wind (Andreotti, Claudin & Pouliquen 2006).
  double reptation_length(const Grain& grain) const;
};

}  // namespace aeolian
