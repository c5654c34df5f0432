#include "aeolian_core/bedforms/erosion/bounce.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr float unit = 0.0384F;  // sqrt(g d) of 0.15 mm

Eigen::Vector3f falling(double speed, double angle) {
  return {static_cast<float>(speed * std::cos(angle)), 0, static_cast<float>(-speed * std::sin(angle))};
}

TEST(Bounce, restitution_is_as_measured) {
  // Beladjine et al. (2007): e = 0.87 - 0.72 sin, e_z = 0.30 / sin - 0.15.
  Bounce bounce;
  bounce.law = BounceLaw::measured;
  for (const double degrees : {5.0, 10.0, 20.0, 40.0, 60.0}) {
    const double angle = degrees * M_PI / 180;
    const BounceResult r = bounced(bounce, falling(3, angle), 0, 0, unit, 0.01F);
    const double sine = std::sin(angle);
    EXPECT_NEAR(r.velocity.norm() / 3, 0.87 - 0.72 * sine, 1e-4) << degrees;
    EXPECT_NEAR(r.velocity.z() / (3 * sine), 0.30 / sine - 0.15, 1e-3) << degrees;
    EXPECT_FALSE(r.captured);
  }
}

TEST(Bounce, pushes_as_many_as_measured_and_none_when_slow) {
  Bounce bounce;
  bounce.push = true;
  const double angle = 10 * M_PI / 180;
  const double e = 0.87 - 0.72 * std::sin(angle);
  const BounceResult fast = bounced(bounce, falling(3, angle), 0, 0, unit, 0.5F);
  EXPECT_NEAR(fast.pushed, 13 * (1 - e * e) * (3 / (40 * unit) - 1), 0.01);
  EXPECT_EQ(bounced(bounce, falling(1, angle), 0, 0, unit, 0.5F).pushed, 0);
}

TEST(Bounce, the_attenuated_law_keeps_fixed_parts_and_stops_what_is_slow) {
  const Bounce bounce;
  const BounceResult r = bounced(bounce, {2, 0, -1}, 0, 0, unit, 0.5F);
  EXPECT_NEAR(r.velocity.x(), 1.2, 1e-5);
  EXPECT_NEAR(r.velocity.z(), 0.3, 1e-5);
  EXPECT_FALSE(r.captured);
  EXPECT_TRUE(bounced(bounce, {0.2F, 0, -0.1F}, 0, 0, unit, 0.5F).captured);
}

TEST(Bounce, a_slope_turns_the_rebound_and_none_gains_speed) {
  const Bounce attenuated;
  Bounce measured;
  measured.law = BounceLaw::measured;
  for (const Bounce& bounce : {attenuated, measured})
    for (const float slope : {-0.6F, -0.2F, 0.0F, 0.3F, 1.0F, 5.0F}) {
      const Eigen::Vector3f v = falling(3, 0.1);
      const BounceResult r = bounced(bounce, v, slope, 0.2F, unit, 0.01F);
      EXPECT_TRUE(r.velocity.allFinite());
      EXPECT_LE(r.velocity.norm(), v.norm());
      const Eigen::Vector3f normal(-slope, -0.2F, 1);
      EXPECT_GT(r.velocity.dot(normal), 0) << "into the bed at a slope of " << slope;
    }
}

}  // namespace
}  // namespace aeolian
