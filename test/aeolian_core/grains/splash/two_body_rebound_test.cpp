#include "aeolian_core/grains/splash/two_body_rebound.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

// The impulse on the grain is given back to the target, whose motion then says what the laws of restitution
// ask.
TEST(TwoBodyReboundTest, restitutions_hold_between_both_bodies) {
  for (const double mass_ratio : {0.1, 0.5, 2.0})
    for (const double sigma : {-0.5, 0.0, 0.7})
      for (const double beta : {-0.4, 0.3}) {
        const double kappa = 0.4, target_kappa = 0.5, epsilon = 0.8, before = 0.25;
        const TwoBodyRebound rebound({mass_ratio, epsilon, sigma, kappa, target_kappa});
        const Eigen::Vector2d normal(-std::sin(beta), std::cos(beta)),
            tangent(std::cos(beta), std::sin(beta));
        const Eigen::Vector2d in(0.9, -0.35);
        double spin = before;
        const Eigen::Vector2d out = rebound.velocity_after(in, normal, spin);
        // Masses: grain 1, target 1 / mass_ratio. Contact is at -r n of the grain and +r n of the target.
        const Eigen::Vector2d target = -mass_ratio * (out - in);
        const double torque = (out - in).dot(tangent);
        EXPECT_NEAR(kappa * (spin - before), torque, 1e-12);
        const double target_spin = torque * mass_ratio / target_kappa;
        EXPECT_NEAR((out - target).dot(normal), -epsilon * in.dot(normal), 1e-12);
        const double slip_before = in.dot(tangent) + before;
        const double slip_after = (out - target).dot(tangent) + spin + target_spin;
        EXPECT_NEAR(slip_after, sigma * slip_before, 1e-12);
      }
}

TEST(TwoBodyReboundTest, coefficients_are_those_of_laemmel_for_spheres) {
  const double epsilon = 0.7, nu = -0.15, mu = epsilon / (1 + epsilon);  // equal grains
  const TwoBodyRebound rebound({mu, epsilon, nu, 0.4, 0.4});
  EXPECT_NEAR(rebound.c4(), (1 + epsilon) / (1 + mu) - 1, 1e-12);
  EXPECT_NEAR(rebound.c2(), 1 - 2.0 / 7 * (1 - nu) / (1 + mu), 1e-12);
}

TEST(TwoBodyReboundTest, elastic_without_friction_keeps_all_energy) {
  const TwoBodyRebound rebound({1e-9, 1, 1, 0.4, 0.4});  // off a wall
  double spin = 0.5;
  const Eigen::Vector2d out = rebound.velocity_after({0.6, -0.8}, {0.6, 0.8}, spin);
  EXPECT_NEAR(out.norm(), 1, 1e-8);
  EXPECT_DOUBLE_EQ(spin, 0.5);
}

}  // namespace
}  // namespace aeolian
