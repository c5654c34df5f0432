#include <string>

#include "erosion_rows.hpp"
#include <fmt/format.h>

#include "aeolian_core/bedforms/erosion/drift_laws.hpp"
#include "aeolian_core/bedforms/erosion/snow_cover.hpp"
#include "aeolian_core/measure/ripple_statistics.hpp"
#include "aeolian_twin/erosion/erosion_history.hpp"
#include "aeolian_twin/erosion/terrain.hpp"

namespace aeolian {
namespace {

const Atmosphere cold_air{1.3, 1.3e-5, 9.81};
constexpr double roughness = 1e-4;

double threshold(const SnowBonding& snow, double age) {
  return lifting_threshold(drifting_snow(), cold_air, 3e-4 * bond_cohesion(snow, bond_degree(snow, age)));
}

ErosionParameters snow_parameters(double age = 0) {
  ErosionParameters p;
  p.flight = FlightMode::hop_table;
  p.roughness = roughness;
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
  return model.advance(map, wind_at_ten_metres(wind, roughness), drifting_snow(), duration).volume.moved;
}

/// Bertholet (2017): forms move in wind above 8 m/s in snow of less than a day; else they stay.
void map_rows(AccuracyTable& table) {
  table.section(
      "Wind and age of the snow",
      "Bertholet (2017): forms move above 8 m/s in snow younger than a day, else they are stationary. "
      "Whether undisturbed snow of that age is lifted, M: moves, -: does not; wrong ones in brackets.");
  const double ages[] = {0.01, 1, 3, 6, 12, 20, 30, 60, 110};
  const double winds[] = {5, 7, 9, 11, 13, 15};
  for (const double exponent : {0.18, 1.0}) {
    SnowBonding snow;
    snow.exponent = exponent;
    snow.temperature = -20;
    int right = 0, all = 0;
    for (const double age : ages) {
      std::string row;
      for (const double wind : winds) {
        const bool moves =
            wind_at_ten_metres(wind, roughness).friction_velocity > threshold(snow, 3600 * age);
        const bool expected = wind > 8 && age < 24;
        right += moves == expected ? 1 : 0;
        ++all;
        row += fmt::format(moves == expected ? " {} " : "({})", moves ? "M" : "-");
      }
      table.statement(fmt::format("exponent {}, {} h old, wind of 5, 7, 9, 11, 13, 15 m/s", exponent, age),
                      row, row.find('(') == std::string::npos);
    }
    table.range_row(fmt::format("exponent {}: share of cases right", exponent), 0.8, 1,
                    static_cast<double>(right) / all);
  }
}

/// Check 12.
void hump_rows(AccuracyTable& table) {
  const auto run = [](bool bonds) {
    HeightMap map = hard_terrain("steep_hump", GridGeometry(0, 0, 0.01, 128, 128));
    lay_sand(map, 0.01, 1);
    ErosionParameters p = snow_parameters();
    if (!bonds) {
      p = ErosionParameters{};
      p.flight = FlightMode::hop_table;
    }
    const Grain grain = bonds ? drifting_snow() : thesis_sand();
    ParticleErosion model(p);
    const WindField wind = bonds ? wind_at_ten_metres(14, roughness) : wind_at_ten_metres(14);
    model.advance(map, wind, grain, 20);
    return model.counts().slid;
  };
  const double sand = run(false);
  const double snow = run(true);
  table.range_row("12: volume slid on the steep hump, snow over sand", 0, 0.7, snow / sand);
}

}  // namespace

void erosion_snow_rows(AccuracyTable& table) {
  table.section(
      "Snow",
      "Facts of specification secs. 3.5, 4 to 6; hop tables, roughness 0.1 mm. "
      "With the measured exponent 0.18 of bonding snow sticks within seconds: in weak wind saltation "
      "starves before it can renew the surface (1.1 times the threshold).");
  const SnowBonding snow;
  table.relative_row("threshold of fresh snow [m/s] (Clifton et al. 2006)", 0.27, threshold(snow, 0), 0.03);
  table.relative_row("threshold of bonded snow [m/s]", 0.69, threshold(snow, 1e6), 0.03);
  const double still = moved(7, 0, 600);
  table.statement("nothing moves at 7 m/s", fmt::format("{:.2g} m^3", still), still == 0);
  const double old = moved(15, 25 * 3600, 600);
  table.statement("nothing moves at 15 m/s after 25 hours", fmt::format("{:.2g} m^3", old), old == 0);
  const double fresh = moved(12, 0, 10);
  table.statement("fresh snow moves at 12 m/s", fmt::format("{:.2g} m^3", fresh), fresh > 0);

  HeightMap map = level_snow(256, 64, 0.005);
  ParticleErosion model(snow_parameters());
  const WindField wind = wind_at_ten_metres(12, roughness);
  model.advance(map, wind, drifting_snow(), 90);
  const HeightMap::Layer before = map.layer(layer::elevation);
  model.advance(map, wind, drifting_snow(), 2);
  const auto shift = pattern_displacement(map.geometry(), before, map.layer(layer::elevation), 0, 0.03);
  table.range_row("ripple marks after 90 s at 12 m/s: wavelength [cm]", 5, 20,
                  100 * crest_wavelength(map.geometry(), before, 0));
  table.range_row("their speed [mm/s] (2.1 for a 22.9 cm ripple, Cornish)", 0.5, 8,
                  shift ? 1000 * *shift / 2 : 0);

  for (const double ratio : {1.1, 1.5, 2.0, 3.0}) {
    HeightMap bed = level_snow(96, 96, 0.005);
    ParticleErosion carried(snow_parameters());
    WindField blowing;
    const double least = threshold(snow, 0);
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
