#include "aeolian_core/slide/mpm/snow_law.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/slide/mpm/return_mapping.hpp"
#include "aeolian_core/surface/require.hpp"

namespace aeolian {

double SnowLaw::shear_modulus() const { return youngs_modulus / (2 * (1 + poisson_ratio)); }
double SnowLaw::lame_modulus() const {
  return youngs_modulus * poisson_ratio / ((1 + poisson_ratio) * (1 - 2 * poisson_ratio));
}
double SnowLaw::bulk_modulus() const { return youngs_modulus / (3 - 6 * poisson_ratio); }
double SnowLaw::bulk_modulus(int dimensions) const {
  return lame_modulus() + 2 * shear_modulus() / dimensions;
}
double SnowLaw::wave_speed() const { return std::sqrt((lame_modulus() + 2 * shear_modulus()) / density); }
double SnowLaw::initial_compaction() const {
  return yield == Yield::cam_clay ? std::asinh(consolidation / bulk_modulus()) / hardening : 0;
}
double SnowLaw::consolidation_at(double compaction) const {
  const double k = bulk_modulus();
  return std::max(k * std::sinh(hardening * std::max(compaction, 0.0)), YieldConstants::weakest * k);
}

double SnowLaw::friction_of_angle(double angle, int dimensions) {
  const double s = std::sin(angle);
  return dimensions == 2 ? std::sqrt(3) * s : 6 * s / (3 - s);
}

void check(const SnowLaw& law) {
  constexpr Require require{"snow"};
  require(law.density > 0 && law.density < 1e5, "density", law.density, "above 0 and below 1e5 kg/m^3");
  require(law.youngs_modulus >= 1e2 && law.youngs_modulus <= 1e11, "Young's modulus", law.youngs_modulus,
          "from 1e2 to 1e11 Pa");
  require(law.poisson_ratio >= 0 && law.poisson_ratio <= 0.49, "Poisson's ratio", law.poisson_ratio,
          "from 0 to 0.49");
  if (law.yield == SnowLaw::Yield::none) return;
  require(law.friction > 0 && law.friction <= 10, "M", law.friction, "above 0 and at most 10");
  if (law.yield == SnowLaw::Yield::drucker_prager) return;
  require(law.cohesion >= 0 && law.cohesion <= 10, "beta", law.cohesion, "from 0 to 10");
  require(law.hardening > 0 && law.hardening <= 100, "xi", law.hardening, "above 0 and at most 100");
  require(law.consolidation > 0 && law.consolidation <= law.bulk_modulus(), "p0", law.consolidation,
          "above 0 and at most the bulk modulus");
}

YieldConstants yield_constants(const SnowLaw& law, int dimensions) {
  YieldConstants k;
  k.yield = law.yield;
  k.dimensions = dimensions;
  k.shear = law.shear_modulus();
  k.bulk = law.bulk_modulus(dimensions);
  k.hardening_modulus = law.bulk_modulus();
  k.hardening = law.hardening;
  k.slope_squared = law.friction * law.friction;
  k.slope = law.friction;
  k.cohesion = law.cohesion;
  return k;
}

}  // namespace aeolian
