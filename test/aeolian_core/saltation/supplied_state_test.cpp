#include "aeolian_core/saltation/supplied_state.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/sampled_kernel.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

SampledKernel road(const SaltatingBed& bed) {
  SplashSampling sampling;
  sampling.events = 200;
  sampling.elevations = 12;
  sampling.slowest = 1.414;
  return {hard_ground_splash(bed.grain), "road", bed.grain, bed.atmosphere, sampling};
}

TEST(SuppliedStateTest, carries_what_comes_and_flies_higher_than_over_sand) {
  const SaltatingBed bed;
  const SteadyState sand = SaltationSolver(bed, KokRennoKernel(bed.grain, bed.atmosphere)).solve(0.5);
  const SteadyState hard = supplied_state(bed, road(bed), 0.5, 0.01);
  ASSERT_TRUE(hard.steady()) << hard.reason;
  EXPECT_NEAR(hard.mass_flux() / 0.01, 1, 0.01);
  EXPECT_GT(hard.mean(hard.landings.apex), 2 * sand.mean(sand.landings.apex));
  const double lost = bed.atmosphere.density * (0.25 - std::pow(hard.surface_friction_velocity, 2));
  EXPECT_NEAR(hard.grain_stress[0] / lost, 1, 1e-8);
}

TEST(SuppliedStateTest, few_grains_leave_the_wind_alone_and_too_many_are_told) {
  const SaltatingBed bed;
  const SteadyState few = supplied_state(bed, road(bed), 0.4, 1e-7);
  ASSERT_TRUE(few.steady()) << few.reason;
  EXPECT_NEAR(few.surface_friction_velocity, 0.4, 1e-4);
  const SteadyState many = supplied_state(bed, road(bed), 0.4, 100);
  EXPECT_EQ(many.outcome, SteadyState::Outcome::none);
  EXPECT_FALSE(many.reason.empty());
}

TEST(SuppliedStateTest, refuses_what_is_not_physical) {
  const SaltatingBed bed;
  const SampledKernel kernel = road(bed);
  EXPECT_THROW(supplied_state(bed, kernel, 0, 0.01), Error);
  EXPECT_THROW(supplied_state(bed, kernel, 0.4, 0), Error);
  EXPECT_THROW(supplied_state(bed, kernel, 0.4, std::nan("")), Error);
}

}  // namespace
}  // namespace aeolian
