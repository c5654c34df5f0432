#include <cmath>

#include "synthetic_profile.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using namespace synthetic;

double cubic(double x) { return 0.1 + x - 3 * x * x + 8 * x * x * x; }

TEST(Resample, FourPointInterpolationIsExactForACubic) {
  ShadowProfile profile;
  for (int i = 0; i < 60; ++i) {
    profile.x.push_back(0.01 * i + 0.002 * std::sin(i));
    profile.z.push_back(cubic(profile.x.back()));
    profile.sigma_z.push_back(1e-4);
  }
  const EvenProfile even = resample(profile, 0.0037, 0.05);
  ASSERT_GT(even.z.size(), 150u);
  for (std::size_t i = 0; i < even.z.size(); ++i)
    EXPECT_NEAR(even.z[i], cubic(even.start + even.step * static_cast<double>(i)), 1e-12);
}

// A bed known in the horizontal frame, seen from an edge that rises by 12 degrees: positions along the edge
// are those of the feet of perpendiculars, which the heights displace.
TEST(Resample, AnInclinedEdgeStillGivesHorizontalDistances) {
  const double inclination = 12 * degree;
  const Curve bed = leaning(0.07, 0.004);
  const double under = 0.02;  // of the bed's base under the edge's origin [m]
  ShadowProfile profile;
  double height = 0;
  double drop = 0;
  for (int i = 0; i < 900; ++i) {
    const double x = i * 0.27e-3;
    const double z = bed(x) - under + 0.2 * x;
    profile.x.push_back(x * std::cos(inclination) + z * std::sin(inclination));
    profile.z.push_back(z);
    height += z / 900;
    drop += (profile.x.back() * std::sin(inclination) - z) / 900;
  }
  for (double& z : profile.z) z -= height;
  profile.sigma_z.assign(900, 1e-5);
  profile.inclination = inclination;
  profile.drop = drop;
  const EvenProfile even = resample(profile, 0.27e-3, 0.003);
  EXPECT_NEAR(even.start, 0, 1e-9);
  EXPECT_NEAR(static_cast<double>(even.z.size()), 900, 1);
  for (std::size_t i = 0; i < even.z.size(); ++i) {
    const double x = even.start + even.step * static_cast<double>(i);
    EXPECT_NEAR(even.z[i], bed(x) - under + 0.2 * x - height, 2e-6);
  }
}

TEST(Resample, TakesTheLongestStretchBetweenWideGaps) {
  ShadowProfile profile = profile_of([](double x) { return x; }, 0.3, 0.001);
  for (const int gone : {80, 81, 82, 83, 84, 85, 200, 201}) {
    profile.z[static_cast<std::size_t>(gone)] = NAN;
  }
  const EvenProfile even = resample(profile, 0.001, 0.005);
  EXPECT_NEAR(even.start, 0.086, 1e-9);
  EXPECT_NEAR(even.start + even.step * static_cast<double>(even.z.size() - 1), 0.3, 1.1e-3);
  for (std::size_t i = 0; i < even.z.size(); ++i)
    EXPECT_NEAR(even.z[i], even.start + even.step * static_cast<double>(i), 1e-12);
}

// A cubic through noise on both sides of a gap would swing far outside.
TEST(Resample, NoiseDoesNotSwingInAGap) {
  ShadowProfile profile = profile_of([](double) { return 0.0; }, 0.1, 0.001);
  add_noise(profile, 1e-3, 4);
  for (std::size_t i = 40; i < 49; ++i) profile.z[i] = NAN;
  const EvenProfile even = resample(profile, 0.0005, 0.02);
  for (std::size_t i = 79; i <= 97; ++i) EXPECT_LE(std::abs(even.z[i]), 3e-3);
}

TEST(Resample, RefusesWhatIsTooLittle) {
  EXPECT_THROW(resample(profile_of(cubic, 0.006, 0.001), 0.001, 0.01), Error);
  EXPECT_THROW(resample(ShadowProfile{}, 0.001, 0.01), Error);
  const ShadowProfile good = profile_of(cubic, 0.3, 0.001);
  EXPECT_THROW(resample(good, 0, 0.01), Error);
  EXPECT_THROW(resample(good, 0.001, NAN), Error);
  EXPECT_THROW(resample(good, 0.1, 0.01), Error);      // four samples are left
  EXPECT_THROW(resample(good, 0.001, 0.0005), Error);  // all is gap
  ShadowProfile nothing = good;
  nothing.z.assign(nothing.z.size(), NAN);
  EXPECT_THROW(resample(nothing, 0.001, 0.01), Error);
  ShadowProfile uneven = good;
  uneven.sigma_z.pop_back();
  EXPECT_THROW(resample(uneven, 0.001, 0.01), Error);
}

TEST(Detrended, TakesOutTheLineAndTellsItsSlope) {
  EvenProfile profile{1, 0.002, {}, {}};
  for (int i = 0; i < 100; ++i) profile.z.push_back(3 - 0.05 * 0.002 * i + (i % 2 == 0 ? 1e-4 : -1e-4));
  double slope = 0;
  const auto level = detrended(profile, &slope);
  EXPECT_NEAR(slope, -0.05, 1e-4);
  double sum = 0;
  for (const double z : level) sum += z;
  EXPECT_NEAR(sum, 0, 1e-12);
}

}  // namespace
}  // namespace aeolian
