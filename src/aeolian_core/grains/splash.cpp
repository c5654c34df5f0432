#include "aeolian_core/grains/splash.hpp"

#include <cmath>

namespace aeolian {

double Splash::ejecta_per_impact(const Grain& grain, double speed) const {
  return ejecta_coefficient * speed / std::sqrt(gravity * grain.diameter);
}

double Splash::reptation_length(const Grain& grain) const { return reptation_diameters * grain.diameter; }

}  // namespace aeolian
