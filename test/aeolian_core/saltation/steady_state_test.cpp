#include "aeolian_core/saltation/steady_state.hpp"

#include <cmath>
#include <limits>
#include <memory>

#include "thesis_bed.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/saltation/delta_kernel.hpp"
#include "aeolian_core/saltation/kok_renno_kernel.hpp"
#include "aeolian_core/saltation/literal_iteration.hpp"
#include "aeolian_core/saltation/profiles.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

bool all_finite(const SteadyState& s) {
  double sum = s.surface_friction_velocity + s.mass_flux() + s.impact_rate() + s.replacement;
  for (const auto* column :
       {&s.launches.number, &s.landings.vx, &s.landings.length, &s.grain_stress, &s.spectrum})
    for (const double value : *column) sum += value;
  for (std::size_t i = 0; i < WindProfile::levels; ++i) sum += s.wind.speed_at_level(i);
  return std::isfinite(sum);
}

/// Saltation specification, sec. 5.2, W1: [R] at the printed parameters. [cm/s], [g/(cm s)].
TEST(SteadyStateTest, agrees_with_the_reference_solver) {
  const struct {
    int number;
    double friction_velocity, surface, flux;
  } rows[] = {{1, 35, 29.6, 0.0433}, {1, 75, 26.15, 0.651}, {1, 125, 22.05, 2.131}, {2, 35, 21.9, 0.0811},
              {2, 75, 16.9, 0.635},  {2, 125, 11.5, 2.02},  {3, 35, 31.6, 0.0237},  {3, 75, 26.25, 0.560},
              {3, 125, 19.2, 1.88},  {5, 50, 35.3, 0.202},  {5, 100, 31.0, 1.57},   {5, 150, 27.4, 4.07},
              {6, 50, 22.4, 0.309},  {6, 100, 16.8, 1.74},  {6, 150, 14.1, 4.52}};
  for (const auto& row : rows) {
    const SaltationSolver solver(thesis_bed(), thesis_splash(row.number));
    const SteadyState s = solver.solve(row.friction_velocity / 100);
    ASSERT_TRUE(s.steady()) << row.number << " " << row.friction_velocity;
    const bool near_threshold = row.friction_velocity < 1.2 * 100 * *solver.impact_threshold();
    EXPECT_NEAR(100 * s.surface_friction_velocity / row.surface, 1,
                row.friction_velocity == 150 ? 0.03 : 0.015);
    EXPECT_NEAR(10 * s.mass_flux() / row.flux, 1, near_threshold ? 0.04 : 0.015)
        << row.number << " " << row.friction_velocity;
    EXPECT_LE(s.iterations, 25);
    EXPECT_LE(solver.solve(1.01 * row.friction_velocity / 100, &s).iterations, 6);
  }
}

/// W2: the thesis' own table with the drag that reproduces it.
TEST(SteadyStateTest, agrees_with_the_thesis_at_the_compatible_drag) {
  const struct {
    int number;
    double friction_velocity, surface;
  } rows[] = {{1, 35, 33.1},  {1, 75, 29.0}, {1, 125, 24.8}, {2, 35, 25.1}, {2, 75, 20.1},
              {2, 125, 13.9}, {3, 75, 30.6}, {3, 125, 24.2}, {5, 50, 40.6}, {5, 100, 35.7},
              {5, 150, 31.1}, {6, 50, 28.0}, {6, 100, 20.4}};
  for (const auto& row : rows) {
    const SteadyState s =
        SaltationSolver(thesis_bed(0.62), thesis_splash(row.number)).solve(row.friction_velocity / 100);
    EXPECT_NEAR(100 * s.surface_friction_velocity / row.surface, 1, 0.08)
        << row.number << " " << row.friction_velocity;
  }
  const SteadyState none = SaltationSolver(thesis_bed(0.62), thesis_splash(3)).solve(0.35);
  EXPECT_EQ(none.outcome, SteadyState::Outcome::below_threshold);
}

/// W6, and that the bed's share tends to the threshold.
TEST(SteadyStateTest, thresholds_are_those_of_the_reference_solver) {
  const double nominal[] = {29.96, 23.2, 32.0, 23.0, 36.4, 25.3};
  for (int number = 1; number <= 6; ++number) {
    const SaltationSolver solver(thesis_bed(), thesis_splash(number));
    const double threshold = *solver.impact_threshold();
    EXPECT_NEAR(100 * threshold / nominal[number - 1], 1, number > 4 ? 0.03 : 0.015) << number;
    const SteadyState below = solver.solve(0.97 * threshold);
    EXPECT_EQ(below.outcome, SteadyState::Outcome::below_threshold) << number;
    EXPECT_EQ(below.mass_flux(), 0);
    EXPECT_FALSE(below.reason.empty());
    const SteadyState above = solver.solve(1.01 * threshold);
    ASSERT_TRUE(above.steady()) << number;
    EXPECT_NEAR(above.surface_friction_velocity / threshold, 1, 0.005) << number;
  }
}

TEST(SteadyStateTest, wind_near_the_bed_falls_as_the_free_wind_rises) {
  for (int number = 1; number <= 6; ++number) {
    const SaltationSolver solver(thesis_bed(), thesis_splash(number));
    double last = 1;
    for (const double u : {0.5, 0.75, 1.0, 1.25}) {
      const double surface = solver.solve(u).surface_friction_velocity;
      EXPECT_LT(surface, last) << number << " " << u;
      last = surface;
    }
  }
}

/// W4 and W5, the identity of sec. 2.2: what the wind loses the grains gain.
TEST(SteadyStateTest, momentum_and_flux_are_conserved) {
  for (int number = 1; number <= 6; ++number) {
    const SaltatingBed bed = thesis_bed();
    const SteadyState s = SaltationSolver(bed, thesis_splash(number)).solve(0.75);
    ASSERT_TRUE(s.steady());
    double gained = 0;
    for (std::size_t k = 0; k < s.launches.size(); ++k)
      gained += s.launches.number[k] * s.grain_mass * (s.landings.vx[k] - s.launches.vx[k]);
    const double lost = bed.atmosphere.density * (0.75 * 0.75 - std::pow(s.surface_friction_velocity, 2));
    EXPECT_NEAR(gained / lost, 1, 1e-5);  // classes that are not worth flying are left out of the sum
    const SaltationProfiles p = profiles(s, bed);
    EXPECT_NEAR(p.stress() / gained, 1, 1e-8);
    EXPECT_NEAR(p.mass_flux(s.grain_mass) / s.mass_flux(), 1, 0.005);
    EXPECT_NEAR(s.grain_stress[0] / lost, 1, 1e-8);
    EXPECT_NEAR(s.replacement, 1, 1e-3);
  }
}

/// Sec. 5.3.
TEST(SteadyStateTest, trajectories_of_case_1_are_those_of_the_reference_solver) {
  const SaltationSolver solver(thesis_bed(), thesis_splash(1));
  const SteadyState s = solver.solve(0.75);
  EXPECT_NEAR(s.mean(s.landings.apex) / 0.0279, 1, 0.02);
  EXPECT_NEAR(s.mean(s.landings.length) / 0.353, 1, 0.02);
  EXPECT_NEAR(s.mean(s.landings.vx) / 3.29, 1, 0.01);
  EXPECT_NEAR(s.mean(s.landings.vy) / 0.597, 1, 0.01);
  EXPECT_NEAR(s.spread(s.launches.vy) / 0.399, 1, 0.02);
  EXPECT_NEAR(s.wind.apparent_roughness() / 0.00110, 1, 0.05);
  const double heights[] = {0.001, 0.005, 0.01, 0.02, 0.05, 0.1};
  const double speeds[] = {3.14, 4.32, 4.94, 5.75, 7.21, 8.51};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(s.wind.speed(heights[i]) / speeds[i], 1, 0.01) << heights[i];
  const double weak = solver.solve(0.35).mean(solver.solve(0.35).landings.vx);
  const SteadyState strong = solver.solve(1.25);
  EXPECT_LT(strong.mean(strong.landings.vx) / weak, 1.10);
}

TEST(SteadyStateTest, bins_twice_as_fine_change_little) {
  const auto splash = DistributionSplash::thesis_case(2);
  const SteadyState coarse = SaltationSolver(thesis_bed(), DistributionKernel(splash, 0.1)).solve(0.75);
  const SteadyState fine = SaltationSolver(thesis_bed(), DistributionKernel(splash, 0.0125)).solve(0.75);
  EXPECT_NEAR(coarse.surface_friction_velocity / fine.surface_friction_velocity, 1, 0.01);
  EXPECT_NEAR(coarse.mass_flux() / fine.mass_flux(), 1, 0.01);
}

TEST(SteadyStateTest, a_neighbouring_wind_is_solved_in_a_few_steps_and_to_the_same_state) {
  const SaltationSolver solver(thesis_bed(), thesis_splash(6));
  SteadyState state = solver.solve(1);
  for (const double u : {1.02, 1.04, 1.02, 1.0}) {
    state = solver.solve(u, &state);
    ASSERT_TRUE(state.steady()) << state.reason;
    EXPECT_LE(state.iterations, 5) << u;
    const SteadyState cold = solver.solve(u);
    EXPECT_GT(cold.iterations, 8) << u;
    EXPECT_NEAR(state.mass_flux(), cold.mass_flux(), 2e-3 * cold.mass_flux()) << u;
    EXPECT_NEAR(state.surface_friction_velocity, cold.surface_friction_velocity,
                3e-3 * cold.surface_friction_velocity)
        << u;
  }
}

TEST(SteadyStateTest, the_way_to_a_state_tells_where_the_next_one_is) {
  const SaltationSolver solver(thesis_bed(), thesis_splash(2));
  const SteadyState first = solver.solve(0.7);
  const SteadyState second = solver.solve(0.714, &first);
  const SteadyState third = solver.solve(0.728, &second);
  SteadyState without_past = second;
  without_past.past = nullptr;
  const SteadyState anew = solver.solve(0.728, &without_past);
  ASSERT_TRUE(third.steady()) << third.reason;
  EXPECT_LE(third.iterations, 2);
  EXPECT_LT(third.iterations, anew.iterations);
  EXPECT_NEAR(third.mass_flux(), anew.mass_flux(), 2e-3 * anew.mass_flux());
}

TEST(SteadyStateTest, a_grid_that_is_too_short_is_extended) {
  const auto splash = DistributionSplash::thesis_case(1);
  const SteadyState grown = SaltationSolver(thesis_bed(), DistributionKernel(splash, 0.05, 1)).solve(1.25);
  const SteadyState wide = SaltationSolver(thesis_bed(), DistributionKernel(splash, 0.05, 6)).solve(1.25);
  ASSERT_TRUE(grown.steady());
  EXPECT_GT(grown.spectrum.size(), 20u);
  EXPECT_NEAR(grown.surface_friction_velocity / wide.surface_friction_velocity, 1, 2e-3);
}

TEST(SteadyStateTest, the_thesis_iteration_comes_to_the_same_state) {
  const SteadyState slow = literal_iteration(thesis_bed(), thesis_splash(1), 0.75, 1e-3);
  const SteadyState fast = SaltationSolver(thesis_bed(), thesis_splash(1)).solve(0.75);
  ASSERT_TRUE(slow.steady());
  EXPECT_NEAR(slow.surface_friction_velocity / fast.surface_friction_velocity, 1, 0.003);
  EXPECT_NEAR(slow.mass_flux() / fast.mass_flux(), 1, 0.003);
  EXPECT_GT(slow.iterations, 3 * fast.iterations);
}

/// Saltation specification, sec. 7: the prototype with the splash of Kok & Renno, 250 um. Its flux was 14 %
/// lower at the same shape: it says neither its distribution of angles nor its treatment of slow grains.
TEST(SteadyStateTest, real_sand_is_near_the_prototype) {
  SaltatingBed bed;
  const SaltationSolver solver(bed, KokRennoKernel(bed.grain, bed.atmosphere));
  EXPECT_NEAR(*solver.impact_threshold() / 0.209, 1, 0.02);
  const struct {
    double friction_velocity, surface, flux, length;
  } rows[] = {{0.3, 0.1995, 0.01137, 0.140}, {0.5, 0.1774, 0.0551, 0.157}, {0.7, 0.157, 0.1294, 0.176}};
  for (const auto& row : rows) {
    const SteadyState s = solver.solve(row.friction_velocity);
    EXPECT_NEAR(s.surface_friction_velocity / row.surface, 1, 0.02);
    EXPECT_NEAR(s.mass_flux() / row.flux, 1.16, 0.03);
    EXPECT_NEAR(s.mean(s.landings.length) / row.length, 1, 0.04);
  }
}

TEST(SteadyStateTest, nothing_is_ever_not_a_number) {
  int blown = 0;
  for (const Atmosphere& air : {Atmosphere::earth(), Atmosphere::mars(), Atmosphere::venus()})
    for (const double diameter : {0.00005, 0.0002, 0.0006, 0.002})
      for (const double u : {0.0, 1e-9, 0.01, 0.15, 0.4, 1.0}) {
        SaltatingBed bed;
        bed.grain.diameter = diameter;
        bed.atmosphere = air;
        const SteadyState s = SaltationSolver(bed, KokRennoKernel(bed.grain, air, {}, 2, 6)).solve(u);
        EXPECT_TRUE(all_finite(s)) << air.density << " " << diameter << " " << u << " " << s.reason;
        EXPECT_EQ(s.steady(), s.mass_flux() > 0) << air.density << " " << diameter << " " << u;
        EXPECT_EQ(s.steady(), s.reason.empty());
        blown += s.steady() ? 1 : 0;
      }
  EXPECT_GT(blown, 20);
}

TEST(SteadyStateTest, a_storm_of_3_m_s_is_solved_for_coarse_sand_and_told_for_dust) {
  SaltatingBed bed;
  bed.grain.diameter = 0.0006;
  const SteadyState storm =
      SaltationSolver(bed, KokRennoKernel(bed.grain, bed.atmosphere, {}, 2, 6)).solve(3);
  EXPECT_TRUE(storm.steady()) << storm.reason;
  EXPECT_TRUE(all_finite(storm));
  bed.grain.diameter = 0.00005;  // thirty times its threshold: the splash makes grains of any touch
  const SteadyState dust = SaltationSolver(bed, KokRennoKernel(bed.grain, bed.atmosphere, {}, 1, 4)).solve(3);
  EXPECT_TRUE(all_finite(dust));
  EXPECT_EQ(dust.steady(), dust.reason.empty());
}

TEST(SteadyStateTest, splash_functions_without_a_balance_are_told_with_the_reason) {
  const SaltatingBed bed = thesis_bed();
  DistributionSplash::Parameters splash = DistributionSplash::thesis_case(1);
  splash.c1 = 0.5;  // never more than half a grain
  const SaltationSolver dying(bed, DistributionKernel(splash));
  EXPECT_EQ(dying.solve(1).outcome, SteadyState::Outcome::below_threshold);
  std::string why;
  EXPECT_FALSE(dying.impact_threshold(&why).has_value());
  EXPECT_FALSE(why.empty());

  splash = DistributionSplash::thesis_case(4);
  splash.c3 = 1000;  // hundreds of grains from any touch
  const SteadyState multiplying = SaltationSolver(bed, DistributionKernel(splash)).solve(1);
  EXPECT_EQ(multiplying.outcome, SteadyState::Outcome::none);
  EXPECT_NE(multiplying.reason.find("more than one"), std::string::npos) << multiplying.reason;
  EXPECT_TRUE(all_finite(multiplying));
}

TEST(SteadyStateTest, one_launch_speed_has_one_trajectory) {
  const SaltatingBed bed;
  const SteadyState s = SaltationSolver(bed, DeltaKernel(bed.grain, bed.atmosphere)).solve(0.5);
  ASSERT_TRUE(s.steady());
  // N = 1 fixes the speed of the impact.
  EXPECT_NEAR(std::hypot(s.landings.vx[0], s.landings.vy[0]), std::sqrt(9.81 * bed.grain.diameter / 3.924e-4),
              0.002);
}

TEST(SteadyStateTest, refuses_what_is_not_physical) {
  const SaltationSolver solver(thesis_bed(), thesis_splash(1));
  for (const double bad : {-0.1, 11.0, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(solver.solve(bad), Error) << bad;
  SaltatingBed bed = thesis_bed();
  bed.grain.diameter = 0;
  EXPECT_THROW(SaltationSolver(bed, thesis_splash(1)), Error);
  bed = thesis_bed();
  bed.atmosphere.density = 3000;
  EXPECT_THROW(SaltationSolver(bed, thesis_splash(1)), Error);
  bed = thesis_bed();
  bed.roughness = -1;
  EXPECT_THROW(SaltationSolver(bed, thesis_splash(1)), Error);
  EXPECT_THROW(SaltationSolver(thesis_bed(0), thesis_splash(1)), Error);
  auto splash = DistributionSplash::thesis_case(1);
  splash.c2 = -1;
  EXPECT_THROW(DistributionKernel{splash}, Error);
}

}  // namespace
}  // namespace aeolian
