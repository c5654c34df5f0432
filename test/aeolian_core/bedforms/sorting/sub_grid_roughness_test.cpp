#include "aeolian_core/bedforms/sorting/sub_grid_roughness.hpp"

#include <cmath>
#include <functional>

#include "sorted_experiments.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using E = SortedExperiment;

RoughnessLaw law_in_cells_of(double cell, double fraction = 0) {
  return roughness_law(E::forcing(), fraction, cell, RippleParameters{});
}

/// r^2 by fourth-order Runge-Kutta in many steps.
double integrated(double v, double time, const std::function<double(double)>& rate) {
  constexpr int steps = 200000;
  const double dt = time / steps;
  for (int n = 0; n < steps; ++n) {
    const double a = rate(v);
    const double b = rate(v + dt / 2 * a);
    const double c = rate(v + dt / 2 * b);
    v += dt / 6 * (a + 2 * b + 2 * c + rate(v + dt * c));
  }
  return v;
}

TEST(SubGridRoughnessTest, a_smooth_bed_is_mottled_to_a_grain_within_seconds) {
  // Specification sec. 3 and 5.3: coarse sand, a quarter of the surface's grains ejected per second; mottled
  // after 5 to 10 s.
  Forcing wind;
  wind.grain.diameter = 0.001;
  const double d = wind.grain.effective_diameter();
  wind.ejection_rate = 0.25 / (d * d);
  wind.reptation_length = 0.04;
  const RoughnessLaw law = roughness_law(sorted_forcing(wind, 0.001), 0, 0.002, RippleParameters{});
  EXPECT_NEAR(law.steady(), d, 1e-12);
  EXPECT_NEAR(law.after(0, 1e6), d, 1e-9);
  EXPECT_GT(law.after(0, 5), 0.9 * d);
  EXPECT_LT(law.after(0, 0.5), 0.5 * d);
  EXPECT_NEAR(law.after(0, 3), d * std::sqrt(1 - std::exp(-2 * 0.25 * 3)), 1e-9);
  EXPECT_NEAR(law.after(5 * d, 3), d * std::sqrt(1 + 24 * std::exp(-2 * 0.25 * 3)), 1e-9);
}

TEST(SubGridRoughnessTest, closed_forms_solve_their_equations) {
  const RoughnessLaw law = law_in_cells_of(0.1);
  ASSERT_GT(law.growth, 0);
  const double mottled = law.grain * law.grain;
  const double most = law.ripples * law.ripples;
  const auto rate = [&](double v) {
    return (v < mottled ? 2 * law.mottling * (1 - v / mottled) : 0) + 2 * law.growth * v * (1 - v / most);
  };
  for (const double start : {0.0, 0.5 * law.grain, 2 * law.grain, 1.5 * law.ripples})
    for (const double time : {0.3, 3.0, 30.0, 300.0})
      EXPECT_NEAR(law.after(start, time), std::sqrt(integrated(start * start, time, rate)),
                  1e-4 * law.ripples)
          << start << ' ' << time;
}

TEST(SubGridRoughnessTest, advancing_twice_is_advancing_once) {
  for (const double cell : {0.002, 0.1}) {
    const RoughnessLaw law = law_in_cells_of(cell, 0.3);
    for (const double t : {0.5, 5.0, 50.0})
      EXPECT_NEAR(law.after(law.after(1e-5, t), 2 * t), law.after(1e-5, 3 * t), 1e-12);
  }
}

TEST(SubGridRoughnessTest, ripples_grow_below_the_grid_only_where_it_does_not_resolve_them) {
  const RoughnessLaw fine = law_in_cells_of(0.002);
  EXPECT_EQ(fine.growth, 0);
  EXPECT_NEAR(fine.after(0, 1e5), fine.grain, 1e-12);
  const RoughnessLaw wide = law_in_cells_of(0.5);
  // The fastest mode of RippleModel's documentation.
  const double contrast = 1 / std::tan(E::impact_angle) - 1;
  const double mu = RippleParameters{}.slope_effect;
  EXPECT_NEAR(wide.wavelength, 2 * M_PI * E::hop / std::sqrt(std::sqrt(contrast / mu) - 1), 1e-6);
  EXPECT_NEAR(wide.growth, E::erosion_rate / E::hop * std::pow(std::sqrt(contrast) - std::sqrt(mu), 2), 1e-9);
  EXPECT_NEAR(wide.after(0, 1e5), wide.wavelength / 17 / std::sqrt(8.0), 1e-12);
  // From a grain on they grow at that rate, but for what saturation takes already.
  const double low = wide.after(wide.grain, 1e-3 / wide.growth) / wide.grain;
  EXPECT_NEAR((low - 1) / 1e-3, 1 - std::pow(wide.grain / wide.ripples, 2), 1e-3);
}

TEST(SubGridRoughnessTest, a_map_keeps_the_roughness_of_each_cell) {
  HeightMap map(GridGeometry(0, 0, 0.002, 3, 1));
  map.add(layer::elevation, 0.0F);
  map.layer(layer::elevation)[2] = HeightMap::unknown;
  map.add(layer::coarse_fraction, HeightMap::Layer{0.0F, 1.0F, 0.5F});
  advance_roughness(map, E::forcing(), 1e4, RippleParameters{});
  const SortedForcing forcing = E::forcing();
  EXPECT_NEAR(map.layer(layer::roughness)[0], forcing.fine.grain.effective_diameter(), 1e-9);
  EXPECT_NEAR(map.layer(layer::roughness)[1], forcing.coarse.grain.effective_diameter(), 1e-9);
  EXPECT_TRUE(std::isnan(map.layer(layer::roughness)[2]));

  const HeightMap::Layer before = map.layer(layer::roughness);
  Forcing calm = E::fine();
  calm.ejection_rate = 0;
  advance_roughness(map, sorted_forcing(calm, E::coarse_diameter), 1e4, RippleParameters{});
  EXPECT_EQ(map.layer(layer::roughness)[0], before[0]);

  const double z0 = aerodynamic_roughness(map, E::forcing(), RippleParameters{});
  EXPECT_NEAR(z0, std::sqrt(static_cast<double>(before[0]) * static_cast<double>(before[1])) / 30, 1e-9);

  map.layer(layer::roughness)[0] = -1;
  EXPECT_THROW(advance_roughness(map, E::forcing(), 1, RippleParameters{}), Error);
  map.add(layer::roughness, 0.0F);
  EXPECT_THROW(aerodynamic_roughness(map, E::forcing(), RippleParameters{}), Error);
}

TEST(SubGridRoughnessTest, the_wind_feels_grains_and_then_ripples) {
  const RoughnessLaw law = law_in_cells_of(0.5);
  EXPECT_NEAR(aerodynamic_roughness(law.grain, law), law.grain / 30, 1e-12);
  // Lettau: half the height times the height over the spacing, for ridges across the wind.
  const double height = law.wavelength / 17;
  const double ripples = aerodynamic_roughness(std::hypot(law.ripples, law.grain), law) - law.grain / 30;
  EXPECT_NEAR(ripples, 0.5 * height * height / law.wavelength, 1e-9);
  double before = 0;
  for (double r = 0; r < law.ripples; r += law.ripples / 100) {
    EXPECT_GE(aerodynamic_roughness(r, law), before);
    before = aerodynamic_roughness(r, law);
  }
}

TEST(SortedForcingTest, coarse_grains_move_deeper_but_less_far) {
  const SortedForcing f = sorted_forcing(0.45, 0.3, Grain{}, 0.0005);
  EXPECT_NEAR(f.coarse.erosion_rate() / f.fine.erosion_rate(), 2, 1e-9);
  EXPECT_NEAR(f.coarse.reptation_length / f.fine.reptation_length, 0.25, 1e-9);
  EXPECT_EQ(f.coarse.direction, 0.3);
  EXPECT_EQ(f.coarse.impact_angle, f.fine.impact_angle);
  const SortedForcing same = sorted_forcing(f.fine, f.fine.grain.diameter);
  EXPECT_EQ(same.coarse.ejection_rate, f.fine.ejection_rate);
  EXPECT_EQ(same.coarse.reptation_length, f.fine.reptation_length);
  EXPECT_GE(sorted_forcing(f.fine, 0.002).coarse.reptation_length, 0.002);
  EXPECT_THROW(sorted_forcing(f.fine, 0.0001), Error);
  SortedForcing two_winds = f;
  two_winds.coarse.direction += 1;
  EXPECT_THROW(check(two_winds, 1), Error);
}

}  // namespace
}  // namespace aeolian
