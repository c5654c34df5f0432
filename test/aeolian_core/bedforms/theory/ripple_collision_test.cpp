#include "aeolian_core/bedforms/theory/ripple_collision.hpp"

#include <cmath>
#include <limits>

#include "../../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// The table of specification sec. 4.
struct Case {
  double ratio, target_least, brink_least, brink_upstream, brink_downstream;
};
constexpr Case table[] = {{0.9, 0.960, 0.949, 0.973, 0.929}, {0.8, 0.913, 0.889, 0.949, 0.860},
                          {0.7, 0.856, 0.817, 0.927, 0.794}, {0.6, 0.787, 0.733, 0.908, 0.731},
                          {0.5, 0.705, 0.636, 0.894, 0.672}, {0.3, 0.489, 0.403, 0.879, 0.564}};

TEST(RippleCollisionTest, target_ejection_exchanges_the_sizes) {
  for (const double ratio : {0.05, 0.3, 0.5, 0.7, 0.9, 0.99}) {
    const RipplePair after = collide(ratio, EjectionLaw::target).after();
    EXPECT_NEAR(after.upstream, 1, 1e-6) << ratio;
    EXPECT_NEAR(after.downstream / ratio, 1, 1e-6) << ratio;
    EXPECT_NEAR(after.overlap, 0, 1e-12) << ratio;
  }
}

TEST(RippleCollisionTest, brink_ejection_evens_the_sizes) {
  for (const Case& c : table) {
    const RipplePair after = collide(c.ratio, EjectionLaw::brink).after();
    EXPECT_NEAR(after.upstream, c.brink_upstream, 0.002) << c.ratio;
    EXPECT_NEAR(after.downstream, c.brink_downstream, 0.002) << c.ratio;
    EXPECT_GT(after.downstream / after.upstream, c.ratio);
  }
}

TEST(RippleCollisionTest, effective_height_dips_as_specified) {
  for (const Case& c : table) {
    EXPECT_NEAR(collide(c.ratio, EjectionLaw::target).least_effective_height(), c.target_least, 0.002)
        << c.ratio;
    EXPECT_NEAR(collide(c.ratio, EjectionLaw::brink).least_effective_height(), c.brink_least, 0.002)
        << c.ratio;
  }
}

TEST(RippleCollisionTest, sand_is_conserved_and_the_pair_never_merges) {
  for (const EjectionLaw ejection : {EjectionLaw::target, EjectionLaw::brink})
    for (const double ratio : {0.05, 0.5, 0.95}) {
      const Collision collision = collide(ratio, ejection);
      for (const RipplePair& p : collision.course) {
        ASSERT_NEAR(p.sand(), 1 + ratio * ratio, 1e-9) << ratio;
        ASSERT_GT(p.effective_height(), 0);
      }
    }
}

TEST(RippleCollisionTest, refuses_pairs_that_do_not_meet) {
  for (const double ratio : {1.0, 2.0, 0.0, -0.5, 0.01, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_NE(error_of([&] { collide(ratio, EjectionLaw::target); }), "no error was thrown") << ratio;
  EXPECT_EQ(
      error_of([] { collide(1, EjectionLaw::target); }),
      "collision of ripples: upstream over downstream height is 1.000000, must be from 0.05 to below 1");
}

}  // namespace
}  // namespace aeolian
