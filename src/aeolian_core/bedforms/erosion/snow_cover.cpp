#include "aeolian_core/bedforms/erosion/snow_cover.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr double gas_constant = 8.314;  ///< [J/(mol K)]
constexpr double freezing = 273.15;     ///< [K]

}  // namespace

double bonding_time(const SnowBonding& snow) {
  const double warmer = 1 / (freezing + snow.reference) - 1 / (freezing + std::min(snow.temperature, 0.0));
  return snow.bonding_time * std::exp(-std::max(0.0, snow.activation_energy / gas_constant * warmer));
}

double bond_degree(const SnowBonding& snow, double age) {
  return age > 0 ? std::min(1.0, std::pow(age / bonding_time(snow), snow.exponent)) : 0;
}

double bond_cohesion(const SnowBonding& snow, double degree) {
  return snow.fresh_cohesion + (snow.bonded_cohesion - snow.fresh_cohesion) * degree;
}

Grain drifting_snow() {
  Grain grain;
  grain.diameter = 0.0002;
  grain.density = 917;
  grain.porosity = 0.78;
  grain.angle_of_repose = 38 * M_PI / 180;
  return grain;
}

SnowCover::SnowCover(const SnowBonding& snow, const ErodibleBed& bed)
    : snow_(snow),
      skin_(snow.skin * ErodibleBed::parcel_units),
      born_(bed.geometry().size(), -snow.initial_age) {}

void SnowCover::deposited(std::size_t cell, std::int32_t units) {
  born_[cell] = now_ - age(cell) * std::max(0.0, 1 - units / skin_);
}

std::int64_t SnowCover::advance(ErodibleBed& bed, double duration, double bulk_density) {
  now_ += duration;
  owed_ += snow_.snowfall * duration / bulk_density / bed.unit();
  const auto fallen = static_cast<std::int32_t>(std::min(owed_, 1e9));
  owed_ -= fallen;
  const double full = bonding_time(snow_);
  std::int64_t total = 0;
  for (std::size_t i = 0; i < born_.size(); ++i) {
    if (fallen > 0 && !bed.hole(i)) {
      bed.add_loose(i, fallen);
      deposited(i, fallen);
      total += fallen;
    }
    if (bed.loose(i) > 0 && age(i) >= full) bed.sinter(i);
  }
  if (snow_.temperature >= 0) bed.turn_to_ground();
  return total;
}

}  // namespace aeolian
