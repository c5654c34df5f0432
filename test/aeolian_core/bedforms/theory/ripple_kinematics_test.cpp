#include "aeolian_core/bedforms/theory/ripple_kinematics.hpp"

#include <cmath>

#include "../../../error_of.hpp"
#include "ripple_experiments.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

using Bed = RippleExperiment;

TEST(RippleKinematicsTest, a_profile_that_moves_tells_its_speed_and_base) {
  constexpr double speed = 3e-4;
  constexpr double base = 0.02;
  constexpr double duration = 1e-3;
  constexpr double spacing = 1e-4;
  const auto profile = [](double x) {
    return base + 0.004 * std::sin(20 * M_PI * x) + 0.002 * std::sin(40 * M_PI * x + 1);
  };
  std::vector<double> before, after;
  for (int i = 0; i < 1000; ++i) {
    before.push_back(profile(spacing * i));
    after.push_back(profile(spacing * i - speed * duration));
  }
  const std::vector<double> flux = flux_between(before, after, spacing, duration);
  const MovingShape fit = fit_translation(before, flux);
  EXPECT_NEAR(fit.speed, speed, 1e-3 * speed);
  EXPECT_GT(fit.determination, 0.99999);
  // No flux is counted half a spacing upwind of the first sample, so that h = h0 there.
  EXPECT_NEAR(fit.base, profile(-spacing / 2), 1e-6);
}

TEST(RippleKinematicsTest, a_ripple_of_the_model_moves_as_equation_5_5_says) {
  const MovingShape fit = translation_of_a_grown_ripple(6);
  EXPECT_GT(fit.determination, 0.99);
  EXPECT_GT(fit.speed, 0);
}

TEST(RippleKinematicsTest, slopes_gather_impacts_and_lose_them) {
  EXPECT_DOUBLE_EQ(impact_ratio(0, Bed::impact_angle), 1);
  EXPECT_NEAR(impact_ratio(std::tan(Bed::impact_angle), Bed::impact_angle), 2, 1e-12);
  EXPECT_NEAR(impact_ratio(-std::tan(Bed::impact_angle), Bed::impact_angle), 0, 1e-12);
  EXPECT_EQ(impact_ratio(-1, Bed::impact_angle), 0);
}

TEST(RippleKinematicsTest, long_waves_grow_by_negative_diffusion) {
  const double diffusivity = bed_diffusivity(Bed::erosion_rate, Bed::hop, Bed::impact_angle);
  EXPECT_LT(diffusivity, 0);
  for (const double hops : {30, 60, 120}) {
    const double k = 2 * M_PI / (hops * Bed::hop);
    EXPECT_NEAR(growth_rate_of_a_wave(hops) / (-diffusivity * k * k), 1, 0.02) << hops;
  }
  for (const double hops : {1.5, 3.1, 6.0, 60.0}) {
    const double expected =
        growth_rate(Bed::erosion_rate, Bed::hop, Bed::impact_angle, 2 * M_PI / (hops * Bed::hop));
    EXPECT_NEAR(growth_rate_of_a_wave(hops) / expected, 1, 0.03) << hops;
  }
}

TEST(RippleKinematicsTest, refuses_what_cannot_be_compared) {
  EXPECT_EQ(error_of([] {
              fit_translation({1, 2, 3}, {1, 2});
            }),
            "heights and fluxes of a ripple: 3 and 2 values, must be equally many and at least 3");
  EXPECT_EQ(error_of([] {
              fit_translation({1, 2, 3}, {1, 1, 1});
            }),
            "fluxes over a ripple: all the same, nothing moves");
  EXPECT_EQ(error_of([] { flux_between({1}, {}, 1, 1); }),
            "a profile before and after: 1 and 0 values, must be equally many and at least 1");
}

}  // namespace
}  // namespace aeolian
