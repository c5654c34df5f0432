// Flights against the golden tables of the specification (szabo-snow-erosion, secs. 2.2 and 2.4).
#include "aeolian_core/bedforms/erosion/hop_table.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/bedforms/erosion/drift_laws.hpp"
#include "aeolian_core/bedforms/erosion/erodible_bed.hpp"
#include "aeolian_core/bedforms/erosion/parcel_flight.hpp"
#include "aeolian_core/saltation/drag.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

const Atmosphere air{1.225, 1.5e-5, 9.81};

Grain grain_of(double diameter_mm, double density = 2650) {
  Grain grain;
  grain.diameter = diameter_mm / 1000;
  grain.density = density;
  return grain;
}

HopWind golden_wind(double speed) { return {friction_velocity(speed, 10, 5e-6), 5e-6, grain_of(0.15), air}; }

TEST(DriftLaws, golden_thresholds) {
  const double diameter[] = {0.10, 0.15, 0.20, 0.25, 0.30, 0.50};
  const double sand[] = {0.2371, 0.2434, 0.2594, 0.2780, 0.2972, 0.3695};
  const double ice[] = {0.1979, 0.1834, 0.1820, 0.1861, 0.1927, 0.2262};
  for (int i = 0; i < 6; ++i) {
    EXPECT_NEAR(lifting_threshold(grain_of(diameter[i]), air, 3e-4), sand[i], 0.005 * sand[i]);
    EXPECT_NEAR(lifting_threshold(grain_of(diameter[i], 917), air, 3e-4), ice[i], 0.005 * ice[i]);
  }
}

TEST(DriftLaws, saturated_fluxes_are_those_of_the_specification) {
  const double threshold = lifting_threshold(grain_of(0.15), air, 3e-4);
  const double wind[] = {10, 12, 15};
  const double low[] = {0.003, 0.005, 0.010};
  const double high[] = {0.005, 0.009, 0.016};
  for (int i = 0; i < 3; ++i) {
    const double flux = saturated_sand_flux(friction_velocity(wind[i], 10, 5e-6), threshold, air);
    EXPECT_GT(flux, low[i] - 0.0005);
    EXPECT_LT(flux, high[i] + 0.0005);
  }
  EXPECT_EQ(saturated_sand_flux(threshold, threshold, air), 0);
  EXPECT_EQ(saturated_snow_flux(0.27, 0.27, air), 0);
}

TEST(FlownHop, golden_hops_of_sand) {
  struct Golden {
    double wind, range, apex_mm;
  };
  for (const Golden& g : {Golden{10, 0.141, 6.2}, Golden{12, 0.226, 8.2}, Golden{15, 0.392, 11.2}}) {
    const HopWind wind = golden_wind(g.wind);
    const double speed = 1.5 * wind.friction_velocity;
    const Hop hop = flown_hop(wind, speed, speed);
    EXPECT_NEAR(hop.range, g.range, 0.03 * g.range);
    EXPECT_NEAR(1000 * hop.apex, g.apex_mm, 0.03 * g.apex_mm);
  }
  const HopWind wind = golden_wind(10);
  const double speed = 1.5 * wind.friction_velocity;
  const Hop hop = flown_hop(wind, speed, speed);
  EXPECT_NEAR(hop.time, 0.071, 0.03 * 0.071);
  EXPECT_NEAR(std::hypot(hop.along, hop.down), 2.97, 0.03 * 2.97);
  EXPECT_NEAR(std::atan2(hop.down, hop.along) * 180 / M_PI, 5.9, 0.3);
}

TEST(FlownHop, what_falls_far_falls_at_the_terminal_speed) {
  for (const double diameter : {0.15, 0.25}) {
    const Grain grain = grain_of(diameter);
    const Hop hop = flown_hop({1e-6, 1e-5, grain, air}, 0, 25);
    EXPECT_NEAR(hop.down, terminal_speed(DragLaw::sphere, grain, air), 0.03 * hop.down);
  }
  // Specification: sand and ice of 0.15, 0.25 and 0.40 mm.
  const double speeds[][3] = {{0.15, 1.00, 0.43}, {0.25, 1.83, 0.86}, {0.40, 2.93, 1.46}};
  for (const auto& s : speeds) {
    EXPECT_NEAR(terminal_speed(DragLaw::sphere, grain_of(s[0]), air), s[1], 0.03 * s[1]);
    EXPECT_NEAR(terminal_speed(DragLaw::sphere, grain_of(s[0], 917), air), s[2], 0.03 * s[2]);
  }
}

TEST(HopTable, is_within_three_per_cent_of_the_integrator) {
  for (const double speed : {10.0, 15.0}) {
    const HopWind wind = golden_wind(speed);
    const HopTable table(wind, 4, 1.5);
    for (const double along : {0.02, 0.3, 0.7, 2.1, 3.7})
      for (const double up : {0.05, 0.21, 0.4, 0.77, 1.3}) {
        const Hop exact = flown_hop(wind, along, up, 2e-5);
        const Hop looked_up = table.at(static_cast<float>(along), static_cast<float>(up));
        EXPECT_NEAR(looked_up.range, exact.range, 0.03 * exact.range) << along << " " << up;
        EXPECT_NEAR(looked_up.apex, exact.apex, 0.03 * exact.apex) << along << " " << up;
        EXPECT_NEAR(looked_up.time, exact.time, 0.03 * exact.time) << along << " " << up;
        EXPECT_NEAR(looked_up.along, exact.along, 0.03 * exact.along) << along << " " << up;
        EXPECT_NEAR(looked_up.down, exact.down, 0.03 * exact.down) << along << " " << up;
      }
  }
}

/// A parcel over flat ground, to where it meets it.
Hop kernel_hop(const HopWind& wind, double speed, double step, bool as_cells) {
  HeightMap map(GridGeometry(0, 0, 0.005, 256, 8));
  map.add(layer::elevation, 0);
  const ErodibleBed bed(map, 1.5e-4, true);
  ParcelStep s = flight_step(bed, wind.grain, wind.air, wind.roughness, step);
  s.uniform_shear_x = static_cast<float>(wind.friction_velocity / von_karman);
  std::vector<float> shear;
  if (as_cells) {
    for (int n = 0; n < bed.stride() * 9; ++n) shear.insert(shear.end(), {s.uniform_shear_x, 0});
    s.shear = shear.data();
    s.uniform_shear_x = 0;
  }
  Parcels parcels;
  const auto v = static_cast<float>(speed);
  for (int n = 0; n < 11; ++n) parcels.add(3, 4, 2e-6F, v, 0, v, 0);
  Hop hop;
  for (int n = 0; n < 10000; ++n) {
    fly(parcels, 0, parcels.size(), s);
    if (parcels.clearance[10] <= 0) break;
    hop.apex = std::max(hop.apex, static_cast<double>(parcels.z[10]));
    hop.time += step;
  }
  const double late = -parcels.clearance[10] / -parcels.vz[10];
  hop.range = (parcels.x[10] - 3) * 0.005 - late * parcels.vx[10];
  hop.time -= late;
  for (int n = 0; n < 10; ++n) EXPECT_EQ(parcels.x[static_cast<std::size_t>(n)], parcels.x[10]);
  return hop;
}

TEST(ParcelFlight, golden_hops_with_a_step_of_a_millisecond) {
  for (const bool as_cells : {false, true})
    for (const double speed : {10.0, 12.0, 15.0}) {
      const HopWind wind = golden_wind(speed);
      const double v = 1.5 * wind.friction_velocity;
      const Hop exact = flown_hop(wind, v, v, 2e-5);
      const Hop hop = kernel_hop(wind, v, 1e-3, as_cells);
      EXPECT_NEAR(hop.range, exact.range, 0.03 * exact.range);
      EXPECT_NEAR(hop.apex, exact.apex, 0.03 * exact.apex);
      EXPECT_NEAR(hop.time, exact.time, 0.03 * exact.time);
    }
}

}  // namespace
}  // namespace aeolian
