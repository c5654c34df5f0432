#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "erosion_bond_map.hpp"
#include <fmt/format.h>

#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_twin/erosion/erosion_history.hpp"
#include "aeolian_twin/erosion/terrain.hpp"

namespace aeolian {
namespace {

ErosionParameters snow_parameters(double age = 0) {
  ErosionParameters p;
  p.flight = FlightMode::hop_table;
  p.roughness = snow_roughness;
  p.air = cold_air;
  p.snow = SnowBonding{};
  p.snow->initial_age = age;
  return p;
}

HeightMap level_snow(int nx, int ny, double cell) {
  HeightMap map(GridGeometry(0, 0, cell, nx, ny));
  map.add(layer::ground, 0);
  lay_sand(map, 0.03, 1);
  return map;
}

double moved(double wind, double age, double duration) {
  HeightMap map = level_snow(64, 64, 0.01);
  ParticleErosion model(snow_parameters(age));
  return model.advance(map, wind_at_ten_metres(wind, snow_roughness), drifting_snow(), duration).volume.moved;
}

/// Cases of the map that are right.
void map_rows(AccuracyTable& table) {
  table.section(
      "Wind and age of the snow",
      "Bertholet (2017): forms move above 8 m/s in snow younger than a day, else they are "
      "stationary. Flux over its law in a wind of 5, 7, 9, 11, 13, 15 m/s that blows since the snow "
      "fell; more than 0.05 is motion. Wrong ones in brackets. Then the same for snow that lay "
      "undisturbed until then, by its threshold, for three exponents of bonding. The picture: "
      "erosion_bonds.svg.");
  const double own = SnowBonding{}.exponent;
  std::vector<std::vector<double>> flux;
  for (const double wind : snow_winds) flux.push_back(flux_with_age(wind, own));
  int right = 0, all = 0;
  for (std::size_t a = 0; a < snow_ages.size(); ++a) {
    std::string row;
    for (std::size_t w = 0; w < snow_winds.size(); ++w) {
      const bool agrees = (flux[w][a] > 0.05) == bertholet_moves(snow_winds[w], snow_ages[a]);
      right += agrees ? 1 : 0;
      ++all;
      row += fmt::format(agrees ? " {:.2f}" : " ({:.2f})", flux[w][a]);
    }
    table.statement(fmt::format("exponent {}, {} h old", own, snow_ages[a]), row,
                    row.find('(') == std::string::npos);
  }
  table.range_row(fmt::format("exponent {}, wind since the snow fell: share of cases right", own), 0.8, 1,
                  static_cast<double>(right) / all);
  for (const double exponent : {0.18, 0.36, 1.0}) {
    SnowBonding snow;
    snow.exponent = exponent;
    snow.temperature = -20;
    int agree = 0;
    for (const double wind : snow_winds)
      for (const double age : snow_ages) {
        const double friction = wind_at_ten_metres(wind, snow_roughness).friction_velocity;
        agree += (friction > snow_threshold(snow, 3600 * age)) == bertholet_moves(wind, age) ? 1 : 0;
      }
    table.range_row(fmt::format("exponent {}, undisturbed until then: share of cases right", exponent), 0.8,
                    1, static_cast<double>(agree) / all);
  }
}

/// Check 12: at equal time, and when the wind has carried as much volume (a tenth of the mass weighs as much
/// in snow).
void hump_rows(AccuracyTable& table) {
  struct Slid {
    double by_time = 0, by_volume = 0;  ///< [m^3]
  };
  constexpr double enough = 5e-4;  ///< transported [m^4]
  const auto run = [](bool snow) {
    HeightMap map = hard_terrain("steep_hump", GridGeometry(0, 0, 0.01, 128, 128));
    lay_sand(map, 0.01, 1);
    ErosionParameters p = snow_parameters();
    if (!snow) {
      p = ErosionParameters{};
      p.flight = FlightMode::hop_table;
    }
    ParticleErosion model(p);
    Slid slid;
    for (double time = 2; time <= 200 && (time <= 20 || slid.by_volume == 0); time += 2) {
      model.advance(map, snow ? wind_at_ten_metres(14, snow_roughness) : wind_at_ten_metres(14),
                    snow ? drifting_snow() : thesis_sand(), 2);
      if (time == 20) slid.by_time = model.counts().slid;
      if (slid.by_volume == 0 && model.counts().transported >= enough) slid.by_volume = model.counts().slid;
    }
    return slid;
  };
  const Slid sand = run(false);
  const Slid snow = run(true);
  table.range_row("12: volume slid on the steep hump in 20 s, snow over sand", 0, 0.7,
                  snow.by_time / sand.by_time);
  const double bulk = drifting_snow().density * (1 - drifting_snow().porosity) /
                      (thesis_sand().density * (1 - thesis_sand().porosity));
  table.range_row("12: its mass", 0, 0.7, bulk * snow.by_time / sand.by_time);
  table.range_row("12: volume slid once the wind has carried as much, snow over sand", 0, 0.7,
                  snow.by_volume / sand.by_volume);
}

}  // namespace

void erosion_snow_rows(AccuracyTable& table) {
  table.section(
      "Snow",
      "Facts of specification secs. 3.5, 4 to 6; hop tables, roughness 0.1 mm. Bonds grow with the 0.36th "
      "power of time, which is that of their area where the ratio of bond to grain grows with the measured "
      "0.18th; impacts break them (docs/blow_surface.md).");
  const SnowBonding snow;
  table.relative_row("threshold of fresh snow [m/s] (Clifton et al. 2006)", 0.27, snow_threshold(snow, 0),
                     0.03);
  table.relative_row("threshold of bonded snow [m/s]", 0.69, snow_threshold(snow, 1e6), 0.03);
  const double still = moved(7, 0, 600);
  table.statement("nothing moves at 7 m/s", fmt::format("{:.2g} m^3", still), still == 0);
  const double old = moved(15, 25 * 3600, 600);
  table.statement("nothing moves at 15 m/s after 25 hours", fmt::format("{:.2g} m^3", old), old == 0);
  const double fresh = moved(12, 0, 10);
  table.statement("fresh snow moves at 12 m/s", fmt::format("{:.2g} m^3", fresh), fresh > 0);

  HeightMap map = level_snow(256, 64, 0.005);
  ParticleErosion model(snow_parameters());
  const WindField wind = wind_at_ten_metres(12, snow_roughness);
  model.advance(map, wind, drifting_snow(), 90);
  const HeightMap::Layer formed = map.layer(layer::elevation);
  const double wavelength = crest_wavelength(map.geometry(), formed, 0);
  double speed = 0, squares = 0;
  int told = 0;
  for (int n = 0; n < 10; ++n) {
    const HeightMap::Layer before = map.layer(layer::elevation);
    model.advance(map, wind, drifting_snow(), 2);
    const auto shift =
        pattern_displacement(map.geometry(), before, map.layer(layer::elevation), 0, 0.4 * wavelength);
    if (!shift) continue;
    speed += 1000 * *shift / 2;
    squares += std::pow(1000 * *shift / 2, 2);
    ++told;
  }
  speed /= std::max(told, 1);
  const double speed_error = told > 1 ? std::sqrt((squares / told - speed * speed) / (told - 1)) : 0;
  table.range_row("ripple marks after 90 s at 12 m/s: wavelength [cm]", 5, 20, 100 * wavelength);
  table.range_row("their speed [mm/s] (2.1 for a 22.9 cm ripple, Cornish)", 0.5, 8, speed, speed_error);

  for (const double ratio : {1.1, 1.5, 2.0, 3.0}) {
    HeightMap bed = level_snow(96, 96, 0.005);
    ParticleErosion carried(snow_parameters());
    WindField blowing;
    const double least = snow_threshold(snow, 0);
    blowing.friction_velocity = ratio * least;
    carried.advance(bed, blowing, drifting_snow(), 2);
    const double begin = carried.counts().transported;
    carried.advance(bed, blowing, drifting_snow(), 2);
    const Grain grain = drifting_snow();
    const double flux =
        (carried.counts().transported - begin) / 2 / (96 * 96 * 25e-6) * grain.density * (1 - grain.porosity);
    table.range_row(fmt::format("flux at {} times the fresh threshold over its law", ratio), 1 / 1.5, 1.5,
                    flux / saturated_snow_flux(blowing.friction_velocity, least, cold_air));
  }
  hump_rows(table);
  map_rows(table);
}

}  // namespace aeolian
