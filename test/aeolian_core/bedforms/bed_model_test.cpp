#include "aeolian_core/bedforms/bed_model.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

Forcing forcing_of(double friction_velocity, double direction = 0) {
  const Grain grain;
  return make_forcing(steady_saltation(friction_velocity, grain), direction, grain, MeanSplash{});
}

TEST(ForcingTest, erosion_rate_is_impacts_times_ejecta_times_volume) {
  // 9.3e6 impacts at 0.56 ejecta of (0.956 x 0.25 mm)^3: 0.071 mm/s.
  EXPECT_NEAR(forcing_of(0.4).erosion_rate(), 7.1e-5, 0.03 * 7.1e-5);
  EXPECT_EQ(forcing_of(0.1).erosion_rate(), 0);
}

TEST(MeanForcingTest, of_equal_forcings_is_the_same) {
  const Forcing one = forcing_of(0.45, 0.3);
  const Forcing mean = mean_forcing({one, one, one}, {1, 2, 0.5});
  EXPECT_NEAR(mean.ejection_rate, one.ejection_rate, 1e-9 * one.ejection_rate);
  EXPECT_NEAR(mean.direction, one.direction, 1e-12);
  EXPECT_NEAR(mean.impact_angle, one.impact_angle, 1e-12);
  EXPECT_NEAR(mean.reptation_length, one.reptation_length, 1e-12);
}

TEST(MeanForcingTest, calm_spells_dilute_the_rate_but_do_not_turn_the_wind) {
  const Forcing gust = forcing_of(0.5, 0.2);
  const Forcing mean = mean_forcing({gust, forcing_of(0, 2.5)}, {1, 3});
  EXPECT_NEAR(mean.ejection_rate, gust.ejection_rate / 4, 1e-9 * gust.ejection_rate);
  EXPECT_NEAR(mean.direction, 0.2, 1e-12);
  EXPECT_NEAR(mean.impact_angle, gust.impact_angle, 1e-12);
}

TEST(MeanForcingTest, gusts_of_different_angles_spread_the_angles) {
  Forcing low = forcing_of(0.4);
  low.impact_angle = 0.1;
  low.impact_angle_spread = 0.03;
  Forcing high = low;
  high.impact_angle = 0.2;
  const Forcing mean = mean_forcing({low, high}, {1, 1});
  EXPECT_NEAR(mean.impact_angle, 0.15, 1e-12);
  EXPECT_NEAR(mean.impact_angle_spread, std::hypot(0.03, 0.05), 1e-12);
}

TEST(MeanForcingTest, friction_velocity_is_that_of_the_spells_that_move_sand) {
  EXPECT_NEAR(mean_forcing({forcing_of(0.5), forcing_of(0)}, {1, 3}).friction_velocity, 0.5, 1e-12);
}

TEST(MeanForcingTest, directions_are_averaged_across_the_cut) {
  const Forcing mean = mean_forcing({forcing_of(0.4, M_PI - 0.1), forcing_of(0.4, -M_PI + 0.1)}, {1, 1});
  EXPECT_NEAR(std::abs(mean.direction), M_PI, 1e-9);
}

TEST(MeanForcingTest, calm_throughout_is_calm) {
  EXPECT_EQ(mean_forcing({forcing_of(0, 1), forcing_of(0.1, 2)}, {1, 1}).ejection_rate, 0);
}

TEST(MeanForcingTest, refuses_what_cannot_be_averaged) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(mean_forcing({}, {}), Error);
  EXPECT_THROW(mean_forcing({forcing_of(0.4)}, {1, 2}), Error);
  EXPECT_THROW(mean_forcing({forcing_of(0.4)}, {0}), Error);
  EXPECT_THROW(mean_forcing({forcing_of(0.4)}, {-1}), Error);
  EXPECT_THROW(mean_forcing({forcing_of(0.4)}, {nan}), Error);
}

TEST(CheckForcingTest, refuses_what_is_not_physical) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Forcing good = forcing_of(0.4);
  EXPECT_NO_THROW(check(good, 1));
  EXPECT_THROW(check(good, -1), Error);
  EXPECT_THROW(check(good, nan), Error);
  Forcing bad = good;
  bad.direction = nan;
  EXPECT_THROW(check(bad, 1), Error);
  bad = good;
  bad.impact_angle = 0;
  EXPECT_THROW(check(bad, 1), Error);
  bad = good;
  bad.impact_angle_spread = -0.1;
  EXPECT_THROW(check(bad, 1), Error);
  bad = good;
  bad.friction_velocity = nan;
  EXPECT_THROW(check(bad, 1), Error);
  bad = good;
  bad.ejection_rate = -1;
  EXPECT_THROW(check(bad, 1), Error);
  bad = good;
  bad.reptation_length = nan;
  EXPECT_THROW(check(bad, 1), Error);
}

}  // namespace
}  // namespace aeolian
