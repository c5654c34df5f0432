#include "aeolian_core/grains/grain.hpp"

#include <cmath>

#include "aeolian_core/surface/require.hpp"

namespace aeolian {
namespace {

constexpr Require require{"grain"};

}  // namespace

double Grain::mass() const { return density * M_PI / 6 * diameter * diameter * diameter; }

double Grain::effective_diameter() const { return diameter * std::cbrt(M_PI / (6 * (1 - porosity))); }

void check(const Grain& grain) {
  require(grain.diameter >= 1e-5 && grain.diameter <= 0.01, "diameter", grain.diameter, "1e-5 to 0.01 m");
  require(grain.density >= 50 && grain.density <= 2e4, "density", grain.density, "50 to 20000 kg/m^3");
  require(grain.porosity >= 0.2 && grain.porosity <= 0.95, "porosity", grain.porosity, "0.2 to 0.95");
  require(grain.angle_of_repose >= 0.1 && grain.angle_of_repose <= 1.4, "angle of repose",
          grain.angle_of_repose, "0.1 to 1.4 rad");
}

}  // namespace aeolian
