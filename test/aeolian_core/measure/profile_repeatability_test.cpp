#include <cmath>

#include "synthetic_profile.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using namespace synthetic;

/// Outlines of ripples alike but for their size, with noise of a given deviation after scaling.
std::vector<EvenProfile> outlines(int count, double deviation) {
  RandomStream random(9, 0);
  std::vector<EvenProfile> result;
  for (int i = 0; i < count; ++i) {
    const double size = 1 + 0.1 * (i - 0.5 * (count - 1)) / count;
    EvenProfile outline{0, 0.07 * size / 100, {}, {}};
    for (int k = 0; k <= 100; ++k)
      outline.z.push_back(size * (leaning(0.07, 0.004)(0.0007 * k) + deviation * random.normal()));
    result.push_back(outline);
  }
  return result;
}

// Specification, row 11: seven profiles of a ripple scatter by half a grain, thirteen ripples by one.
TEST(ProfileRepeatability, ReturnsTheScatterThatWasPutIn) {
  for (const auto& [count, deviation] : {std::pair(7, 0.5 * grain), {13, grain}}) {
    const auto r = profile_repeatability(outlines(count, deviation));
    EXPECT_NEAR(r.deviation, deviation, 0.1 * deviation);
    EXPECT_NEAR(r.wavelength, 0.07, 1e-9);
    EXPECT_NEAR(r.mean.z[50], leaning(0.07, 0.004)(0.035), 2 * deviation);
  }
}

TEST(ProfileRepeatability, SizeIsNoScatter) {
  EXPECT_NEAR(profile_repeatability(outlines(7, 0)).deviation, 0, 1e-9);
}

TEST(ProfileRepeatability, RipplesOfADippingBedAreOutlinedOnTheirTangent) {
  const auto a = analyse(dipping(leaning(0.07, 0.0042), 0.36, 0.0005, 8 * degree));
  std::vector<EvenProfile> ripples;
  for (const auto& ripple : a.ripples) ripples.push_back(ripple_outline(a.even, ripple));
  ASSERT_GE(ripples.size(), 3u);
  const auto r = profile_repeatability(ripples);
  EXPECT_NEAR(r.wavelength, 0.07, 1e-4);
  EXPECT_NEAR(r.deviation, 0, 0.04e-3);
  for (std::size_t i = 0; i < 101; ++i)
    EXPECT_NEAR(r.mean.z[i], leaning(0.07, 0.0042)(0.0007 * static_cast<double>(i)),
                0.1e-3);  // a sample aside
}

TEST(ProfileRepeatability, NeedsTwo) { EXPECT_THROW(profile_repeatability(outlines(1, 0)), Error); }

}  // namespace
}  // namespace aeolian
