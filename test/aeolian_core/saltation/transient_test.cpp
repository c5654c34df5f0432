#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/saltation/flux_response.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/transient_saltation.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

KokRennoKernel coarse_splash(const SaltatingBed& bed) { return {bed.grain, bed.atmosphere, {}, 2, 5}; }

TEST(TransientSaltationTest, grows_from_nothing_into_the_steady_state) {
  const SaltatingBed bed;
  const KokRennoKernel splash = coarse_splash(bed);
  const double steady = SaltationSolver(bed, splash).solve(0.45).mass_flux();
  TransientSaltation saltation(bed, splash, {}, 0.01);
  double ninety = 0;
  while (saltation.time() < 5) {
    saltation.advance(0.05, 0.45);
    if (ninety == 0 && saltation.mass_flux() > 0.9 * steady) ninety = saltation.time();
  }
  EXPECT_NEAR(saltation.mass_flux() / steady, 1, 0.02);
  EXPECT_GT(ninety, 0.5);  // saltation specification, sec. 7: Anderson & Haff
  EXPECT_LT(ninety, 3);
}

TEST(TransientSaltationTest, goes_on_where_it_does_not_start) {
  const SaltatingBed bed;
  const KokRennoKernel splash = coarse_splash(bed);
  const SaltationSolver solver(bed, splash);
  const double between = 0.5 * (*solver.impact_threshold() + bed.fluid_threshold());
  TransientSaltation at_rest(bed, splash, {}, 0.01);
  at_rest.advance(1, between);
  EXPECT_EQ(at_rest.mass_flux(), 0);
  const SteadyState state = solver.solve(between);
  TransientSaltation going(bed, splash, {}, 0.01);
  going.begin(state);
  going.advance(1, between);
  EXPECT_NEAR(going.mass_flux() / state.mass_flux(), 1, 0.05);
  going.advance(1.5, 0.8 * *solver.impact_threshold());
  EXPECT_LT(going.mass_flux(), 0.2 * state.mass_flux());
}

TEST(TransientSaltationTest, a_lull_and_a_storm_stay_finite) {
  const SaltatingBed bed;
  TransientSaltation saltation(bed, coarse_splash(bed), {}, 0.02);
  for (const double u : {3.0, 0.0, 1.0, 0.1, 2.0}) {
    saltation.advance(0.4, u);
    EXPECT_TRUE(std::isfinite(saltation.mass_flux()) && saltation.mass_flux() >= 0) << u;
    EXPECT_LE(saltation.surface_friction_velocity(), 3);
  }
  EXPECT_THROW(saltation.advance(1, -1), Error);
  EXPECT_THROW(saltation.advance(std::nan(""), 1), Error);
  EXPECT_THROW(TransientSaltation(bed, coarse_splash(bed), {}, 0), Error);
}

TEST(FluxResponseTest, relaxes_exactly_whatever_the_steps) {
  const FluxLaw law{0.2, 0.25, 0};
  FluxResponse one(law, 0.25, 1.5), many(law, 0.25, 1.5);
  one.advance(3, 0.5);
  for (int n = 0; n < 30; ++n) many.advance(0.1, 0.5);
  EXPECT_NEAR(one.flux(), law.flux(0.5) * (1 - std::exp(-2.0)), 1e-15);
  EXPECT_NEAR(many.flux(), one.flux(), 1e-14);
}

TEST(FluxResponseTest, starts_at_the_fluid_threshold_and_stops_at_the_impact_threshold) {
  const FluxLaw law{0.2, 0.25, 0};
  FluxResponse response(law, 0.25);
  EXPECT_EQ(response.advance(1, 0.22), 0);
  EXPECT_GT(response.advance(1, 0.3), 0);
  const double going = response.advance(100, 0.22);
  EXPECT_NEAR(going, law.flux(0.22), 1e-12);
  response.advance(100, 0.19);
  EXPECT_NEAR(response.advance(100, 0.22), 0, 1e-12);
  EXPECT_THROW(FluxResponse(law, 0.1), Error);
  EXPECT_THROW(FluxResponse(law, 0.3, 0), Error);
  EXPECT_THROW(response.advance(-1, 0.3), Error);
}

TEST(ThresholdsTest, agree_with_the_specification) {
  SaltatingBed bed;
  EXPECT_NEAR(bed.fluid_threshold(), 0.23, 0.003);
  EXPECT_GT(cohesive_fluid_threshold(bed), bed.fluid_threshold());
  bed.grain = snow_grain(0.0003);
  EXPECT_NEAR(cohesive_fluid_threshold(bed, 1.5e-4), 0.22, 0.05);
  EXPECT_THROW(cohesive_fluid_threshold(bed, -1), Error);
}

TEST(ThresholdsTest, rise_up_slopes_and_vanish_at_repose) {
  EXPECT_DOUBLE_EQ(slope_factor(0, 0.576), 1);
  EXPECT_GT(slope_factor(0.2, 0.576), 1);
  EXPECT_LT(slope_factor(-0.2, 0.576), 1);
  EXPECT_EQ(slope_factor(-0.576, 0.576), 0);
  EXPECT_EQ(slope_factor(-1, 0.576), 0);
  EXPECT_THROW(slope_factor(2, 0.576), Error);
  EXPECT_THROW(slope_factor(0, 0), Error);
}

TEST(FetchTest, flux_adapts_over_the_saturation_length) {
  const SaltatingBed bed;
  const double length = saturation_length(bed);
  EXPECT_NEAR(length, 2.2 * 0.00025 * 2650 / 1.225, 1e-12);
  EXPECT_EQ(flux_at_fetch(1, 0, length), 0);
  EXPECT_NEAR(flux_at_fetch(2, length, length), 2 * (1 - std::exp(-1.0)), 1e-12);
  EXPECT_THROW(flux_at_fetch(1, -1, length), Error);
  EXPECT_THROW(flux_at_fetch(1, 1, 0), Error);
}

}  // namespace
}  // namespace aeolian
