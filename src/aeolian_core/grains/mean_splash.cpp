#include "aeolian_core/grains/mean_splash.hpp"

#include <cmath>

namespace aeolian {

double MeanSplash::ejecta_per_impact(const Grain& grain, double speed) const {
  return ejecta_coefficient * speed / std::sqrt(gravity * grain.diameter);
}

double MeanSplash::reptation_length(const Grain& grain) const { return reptation_diameters * grain.diameter; }

}  // namespace aeolian
