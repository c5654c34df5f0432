#include "aeolian_core/saltation/flight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "thesis_bed.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/saltation/wind_profile.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

TEST(DragTest, coefficients_are_those_of_the_specification) {
  const struct {
    double reynolds, coefficient;
  } rows[] = {{1, 27.40}, {10, 4.2415}, {100, 1.1855}, {500, 0.7048}};
  for (const auto& row : rows)
    EXPECT_NEAR(drag_coefficient(DragLaw::sphere, row.reynolds) / row.coefficient, 1, 1e-4) << row.reynolds;
  EXPECT_NEAR(drag_coefficient(DragLaw::sand, 32), std::pow(2, 1.5), 1e-12);
}

TEST(DragTest, terminal_speeds_are_those_of_the_specification) {
  Grain grain = thesis_bed().grain;
  const struct { double diameter, speed; } rows[] = {{0.00025, 1.82}, {0.00078, 5.09}, {0.001, 6.13}};
  for (const auto& row : rows) {
    grain.diameter = row.diameter;
    EXPECT_NEAR(terminal_speed(DragLaw::sphere, grain, thesis_bed().atmosphere), row.speed, 0.006);
  }
}

TEST(DragTest, the_table_agrees_with_the_law) {
  for (const DragLaw law : {DragLaw::sphere, DragLaw::sand})
    for (const Atmosphere& air : {Atmosphere::earth(), Atmosphere::mars(), Atmosphere::venus()}) {
      const Grain grain = thesis_bed().grain;
      const Drag drag(law, grain, air, 1);
      for (double v = 1e-3; v < 50; v *= 1.07) {
        const double exact = 0.75 * air.density / grain.density / grain.diameter * v *
                             drag_coefficient(law, grain.diameter * v / air.viscosity);
        EXPECT_NEAR(drag.rate(v * v) / exact, 1, 5e-5) << v;
      }
    }
}

TEST(DragTest, refuses_what_is_not_physical) {
  const Grain grain;
  EXPECT_THROW(Drag(DragLaw::sand, grain, {}, 0), Error);
  EXPECT_THROW(Drag(DragLaw::sand, grain, {}, std::nan("")), Error);
  EXPECT_THROW(Drag(DragLaw::sand, grain, {-1, 1e-5, 9.81}, 1), Error);
  EXPECT_THROW(terminal_speed(DragLaw::sand, grain, {1.2, 0, 9.81}), Error);
}

TEST(WindProfileTest, without_grains_it_is_the_law_of_the_wall) {
  WindProfile wind(8.333e-6);
  wind.set_logarithmic(0.5);
  for (double y = 1e-5; y < 10; y *= 1.3)
    EXPECT_NEAR(wind.speed(y), 0.5 / 0.4 * std::log(y / 8.333e-6), 2e-4) << y;
  EXPECT_EQ(wind.speed(1e-6), 0);
  EXPECT_NEAR(wind.apparent_roughness(), 8.333e-6, 1e-11);
}

TEST(WindProfileTest, a_layer_of_grains_at_one_height_parts_two_laws_of_the_wall) {
  WindProfile wind(1e-5);
  std::vector<double> share(WindProfile::levels);
  const std::size_t step = 80;
  for (std::size_t i = 0; i < step; ++i) share[i] = 1;
  wind.set(0.5, 0.2, share);
  const double height = wind.height(step - 1);
  EXPECT_NEAR(wind.speed(height), 0.2 / 0.4 * std::log(height / 1e-5), 1e-9);
  const double above = wind.speed(100 * wind.height(step)) - wind.speed(wind.height(step));
  EXPECT_NEAR(above, 0.5 / 0.4 * std::log(100), 2e-4);
}

TEST(WindProfileTest, a_wind_that_grains_push_falls_with_height) {
  WindProfile wind(1e-5);
  std::vector<double> share(WindProfile::levels, 1.5);
  wind.set(0.5, 0.1, share);
  EXPECT_LT(wind.shear_velocity(10), 0);
  EXPECT_LT(wind.speed_at_level(20), wind.speed_at_level(10));
}

/// Highest points in a wind without grains (saltation specification, sec. 5.8), within its one per cent.
TEST(FlightTest, heights_saturate_as_in_figure_4_22) {
  SaltatingBed bed = thesis_bed();
  WindProfile wind(0.01);
  wind.set_logarithmic(1.6);
  const double speeds[] = {0.5, 1, 2, 3, 4, 6, 8, 10};
  const struct {
    double diameter, from_vertical;
    double apex_cm[8];
  } rows[] = {{0.00025, 0, {1.1, 3.5, 9.6, 16.2, 22.8, 36.0, 48.7, 60.8}},
              {0.001, 0, {1.2, 4.7, 16.5, 32.3, 50.6, 91.5, 135, 180}},
              {0.00025, 60, {1.1, 3.7, 10.7, 18.9, 27.6, 45.4, 61.9, 76.0}},
              {0.001, 60, {1.3, 4.8, 17.4, 35.5, 57.8, 112, 174, 238}}};
  for (const auto& row : rows) {
    bed.grain.diameter = row.diameter;
    const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, 1);
    for (int i = 0; i < 8; ++i) {
      const double along = speeds[i] * std::tan(row.from_vertical * M_PI / 180);
      Landings landings;
      landings.resize(1);
      std::vector<double> stress(WindProfile::levels);
      fly({{along}, {speeds[i]}, {1}}, 0, {wind, drag}, landings, stress);
      // Printed to a tenth of a centimetre.
      EXPECT_NEAR(100 * landings.apex[0], row.apex_cm[i], std::max(0.01 * row.apex_cm[i], 0.06))
          << row.diameter << " " << i;
    }
  }
}

TEST(FlightTest, without_drag_it_is_a_parabola) {
  SaltatingBed bed = thesis_bed();
  const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, 1e-9);
  WindProfile wind(1e-5);
  wind.set_logarithmic(0.5);
  const Launches launches{{0.5, -0.3}, {1.5, 0.4}, {1, 1}};
  Landings landings;
  landings.resize(2);
  std::vector<double> stress(WindProfile::levels);
  fly(launches, 0, {wind, drag}, landings, stress);
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_NEAR(landings.duration[k], 2 * launches.vy[k] / 9.81, 1e-6);
    EXPECT_NEAR(landings.length[k], launches.vx[k] * 2 * launches.vy[k] / 9.81, 1e-6);
    EXPECT_NEAR(landings.apex[k], launches.vy[k] * launches.vy[k] / 2 / 9.81, 1e-6);
    EXPECT_NEAR(landings.vy[k], launches.vy[k], 1e-6);
  }
}

TEST(FlightTest, smaller_tolerances_come_nearer) {
  const SaltatingBed bed = thesis_bed();
  const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, 1);
  WindProfile wind(bed.roughness_length());
  wind.set_logarithmic(0.4);
  Launches launches;
  launches.resize(40);
  for (std::size_t k = 0; k < 40; ++k)
    launches.vy[k] = 0.05 + 0.1 * static_cast<double>(k), launches.number[k] = 1;
  const auto flown = [&](double tolerance) {
    Landings landings;
    landings.resize(40);
    std::vector<double> stress(WindProfile::levels);
    fly(launches, 0, {wind, drag, 9.81, tolerance}, landings, stress);
    return landings;
  };
  const Landings exact = flown(1e-8);
  double last = 1;
  for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
    const Landings landings = flown(tolerance);
    double worst = 0;
    for (std::size_t k = 0; k < 40; ++k)
      worst = std::max(worst, std::abs(landings.length[k] / exact.length[k] - 1));
    EXPECT_LT(worst, last);
    EXPECT_LT(worst, 6 * tolerance);
    last = worst;
  }
}

TEST(FlightTest, stress_at_levels_is_the_momentum_of_the_grains_that_cross) {
  const SaltatingBed bed = thesis_bed();
  const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, 1);
  WindProfile wind(bed.roughness_length());
  wind.set_logarithmic(0.4);
  const Launches launches{{0.2}, {1}, {3}};
  Landings landings;
  landings.resize(1);
  std::vector<double> stress(WindProfile::levels);
  fly(launches, 0, {wind, drag}, landings, stress);
  EXPECT_NEAR(stress[0], 3 * (landings.vx[0] - 0.2), 1e-12);
  // At each level, from the steps of the flight, linear within each.
  const auto steps = trace(0.2, 1, {wind, drag, 9.81, 1e-6});
  for (std::size_t i = 8; i < WindProfile::levels; i += 8) {
    const double height = wind.height(i);
    double expected = 0;
    for (const FlightStep& s : steps) {
      if (s.y0 < height && s.y1 >= height)
        expected -= 3 * (s.vx0 + (height - s.y0) / (s.y1 - s.y0) * (s.vx1 - s.vx0));
      if (s.y0 >= height && s.y1 < height)
        expected += 3 * (s.vx0 + (height - s.y0) / (s.y1 - s.y0) * (s.vx1 - s.vx0));
    }
    EXPECT_NEAR(stress[i], expected, 0.01) << i;
    if (height > landings.apex[0] + wind.roughness()) {
      EXPECT_EQ(stress[i], 0);
    }
  }
}

TEST(FlightTest, classes_do_not_depend_on_their_neighbours) {
  const SaltatingBed bed = thesis_bed();
  const Drag drag(bed.drag_law, bed.grain, bed.atmosphere, 1);
  WindProfile wind(bed.roughness_length());
  wind.set_logarithmic(0.4);
  Launches many;
  many.resize(30);
  for (std::size_t k = 0; k < 30; ++k) many.vy[k] = 0.1 * static_cast<double>(30 - k), many.number[k] = 1;
  many.number[7] = 0;
  Landings all;
  all.resize(30);
  all.vx[7] = 123;
  std::vector<double> stress(WindProfile::levels);
  fly(many, 0, {wind, drag}, all, stress);
  EXPECT_EQ(all.vx[7], 123);  // not flown
  for (const std::size_t k : {0, 13, 29}) {
    Landings alone;
    alone.resize(1);
    fly({{0}, {many.vy[k]}, {1}}, 0, {wind, drag}, alone, stress);
    EXPECT_EQ(alone.length[0], all.length[k]);
    EXPECT_EQ(alone.vx[0], all.vx[k]);
  }
}

}  // namespace
}  // namespace aeolian
