#include "aeolian_core/saltation/saltation_state.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

Grain sand(double diameter) {
  Grain grain;
  grain.diameter = diameter;
  return grain;
}

/// A row of the solved states in the saltation specification, sec. 7.
struct Solved {
  double diameter, friction_velocity, mass_flux, hop_length, impact_speed, impact_angle_deg;
};

TEST(SaltationStateTest, agrees_with_solved_states) {
  const Solved rows[] = {
      {0.00025, 0.22, 0.00114, 0.134, 1.37, 13.6}, {0.00025, 0.30, 0.01137, 0.140, 1.38, 13.8},
      {0.00025, 0.40, 0.02977, 0.148, 1.39, 14.1}, {0.00025, 0.50, 0.0551, 0.157, 1.41, 14.5},
      {0.00025, 0.70, 0.1294, 0.176, 1.43, 15.1},
  };
  for (const Solved& row : rows) {
    const SaltationState state = steady_saltation(row.friction_velocity, sand(row.diameter));
    EXPECT_NEAR(state.mass_flux / row.mass_flux, 1, 0.025) << row.friction_velocity;
    EXPECT_NEAR(state.hop_length / row.hop_length, 1, 0.015) << row.friction_velocity;
    EXPECT_NEAR(state.impact_speed / row.impact_speed, 1, 0.01) << row.friction_velocity;
    EXPECT_NEAR(state.impact_angle / degree, row.impact_angle_deg, 0.1) << row.friction_velocity;
  }
}

TEST(SaltationStateTest, agrees_with_solved_flux_of_coarse_sand) {
  EXPECT_NEAR(steady_saltation(0.30, sand(0.0004)).mass_flux / 0.0052, 1, 0.03);
  EXPECT_NEAR(steady_saltation(0.40, sand(0.0004)).mass_flux / 0.0280, 1, 0.03);
  EXPECT_NEAR(steady_saltation(0.50, sand(0.0004)).mass_flux / 0.0592, 1, 0.03);
}

TEST(SaltationStateTest, impact_rate_is_that_of_the_specification) {
  EXPECT_NEAR(steady_saltation(0.4, sand(0.00025)).impact_rate, 9.3e6, 0.03 * 9.3e6);
}

TEST(SaltationStateTest, nothing_moves_up_to_the_threshold) {
  const Grain grain = sand(0.00025);
  const double threshold = steady_saltation(0, grain).impact_threshold;
  EXPECT_DOUBLE_EQ(threshold, 0.209);
  for (const double u : {0.0, 0.1, threshold}) {
    EXPECT_EQ(steady_saltation(u, grain).mass_flux, 0) << u;
    EXPECT_EQ(steady_saltation(u, grain).impact_rate, 0) << u;
  }
  EXPECT_GT(steady_saltation(threshold * 1.0001, grain).impact_rate, 0);
}

TEST(SaltationStateTest, is_continuous_in_diameter_and_rises_with_wind) {
  for (const double knot : {0.00025, 0.0004}) {
    const SaltationState below = steady_saltation(0.5, sand(knot * (1 - 1e-9)));
    const SaltationState above = steady_saltation(0.5, sand(knot * (1 + 1e-9)));
    EXPECT_NEAR(below.mass_flux / above.mass_flux, 1, 1e-6);
    EXPECT_NEAR(below.impact_rate / above.impact_rate, 1, 1e-6);
    EXPECT_NEAR(below.impact_threshold / above.impact_threshold, 1, 1e-6);
  }
  double last = 0;
  for (double u = 0.21; u < 1; u += 0.01) {
    const double flux = steady_saltation(u, sand(0.00025)).mass_flux;
    EXPECT_GT(flux, last);
    last = flux;
  }
}

TEST(SaltationStateTest, thin_air_needs_more_wind) {
  const Grain grain = sand(0.00025);
  const SaltationState thin = steady_saltation(0.5, grain, 1.225 / 4);
  EXPECT_NEAR(thin.impact_threshold, 2 * steady_saltation(0.5, grain).impact_threshold, 1e-12);
  EXPECT_LT(thin.mass_flux, steady_saltation(0.5, grain).mass_flux / 4);
}

TEST(SaltationStateTest, refuses_what_is_not_physical) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double bad : {-0.1, nan, std::numeric_limits<double>::infinity()})
    EXPECT_THROW(steady_saltation(bad, Grain{}), Error) << bad;
  EXPECT_THROW(steady_saltation(0.4, sand(-1)), Error);
  EXPECT_THROW(steady_saltation(0.4, Grain{}, 0), Error);
  EXPECT_THROW(steady_saltation(0.4, Grain{}, nan), Error);
}

}  // namespace
}  // namespace aeolian
