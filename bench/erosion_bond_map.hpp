#pragma once

#include <array>
#include <vector>

#include "erosion_rows.hpp"

#include "aeolian_core/bedforms/erosion/drift_laws.hpp"
#include "aeolian_core/bedforms/erosion/snow_cover.hpp"

namespace aeolian {

constexpr double snow_roughness = 1e-4;  ///< [m]
inline const Atmosphere cold_air{1.3, 1.3e-5, 9.81};

/// Bertholet (2017): forms move in wind above 8 m/s in snow of less than a day; else they stay.
constexpr std::array<double, 9> snow_ages{0.01, 1, 3, 6, 12, 20, 30, 60, 110};  ///< [h]
constexpr std::array<double, 6> snow_winds{5, 7, 9, 11, 13, 15};                ///< at 10 m [m/s]
inline bool bertholet_moves(double wind, double age) { return wind > 8 && age < 24; }

/// u*_t of snow that was not moved for `age` [s].
inline double snow_threshold(const SnowBonding& snow, double age) {
  return lifting_threshold(drifting_snow(), cold_air, 3e-4 * bond_cohesion(snow, bond_degree(snow, age)));
}

/// Flux over its law at each of the ages, in a wind at 10 m [m/s] that blows since the snow fell; where the
/// law has none, zero. Snow as it comes, the exponent apart; 0.64 m^2 of deep snow.
inline std::vector<double> flux_with_age(double wind_speed, double exponent) {
  HeightMap map(GridGeometry(0, 0, 0.05, 16, 16));
  map.add(layer::ground, 0);
  lay_sand(map, 0.2, 1);
  ErosionParameters p;
  p.flight = FlightMode::hop_table;
  p.roughness = snow_roughness;
  p.air = cold_air;
  p.parcel_thickness = 2e-3;
  p.snow = SnowBonding{};
  p.snow->exponent = exponent;
  p.snow->temperature = -20;
  const Grain grain = drifting_snow();
  const WindField wind = wind_at_ten_metres(wind_speed, snow_roughness);
  const double law = saturated_snow_flux(wind.friction_velocity, snow_threshold(*p.snow, 0), cold_air);
  ParticleErosion model(p);
  std::vector<double> flux;
  double now = 0;
  for (const double age : snow_ages) {
    const double watched = std::min(600.0, 1800 * age);
    model.advance(map, wind, grain, 3600 * age - watched - now);
    const double before = model.counts().transported;
    model.advance(map, wind, grain, watched);
    now = 3600 * age;
    const double carried =
        (model.counts().transported - before) / watched / (0.8 * 0.8) * grain.density * (1 - grain.porosity);
    flux.push_back(law > 0 ? carried / law : 0);
  }
  return flux;
}

}  // namespace aeolian
