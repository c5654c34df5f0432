#include "aeolian_core/measure/profile_analysis.hpp"

#include <cmath>

#include "synthetic_profile.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using namespace synthetic;

// Specification, row 22: cot 5 + cot 10 = 17.1.
TEST(ProfileAnalysis, IndexOfATriangleIsExact) {
  ShadowProfile profile = profile_of(triangles(0.07, 5 * degree, 10 * degree), 0.36, 0.05e-3);
  profile.downwind = 1;
  const auto a = analyse(profile);
  ASSERT_EQ(a.ripples.size(), 4u);  // the first begins with the profile and the last ends after it
  EXPECT_NEAR(a.index.value, 17.1, 0.02);
  EXPECT_NEAR(a.stoss_mean.value, 5 * degree, 0.02 * degree);
  EXPECT_NEAR(a.lee_mean.value, 10 * degree, 0.02 * degree);
  EXPECT_NEAR(a.stoss_max.value, 5 * degree, 0.02 * degree);
  EXPECT_NEAR(a.lee_max.value, 10 * degree, 0.02 * degree);
}

class Dip : public testing::TestWithParam<double> {};

// Row 9. The tangent plane is known: troughs lie on it at whole wavelengths.
TEST_P(Dip, ExtentsAreGoodToASample) {
  const double dip = GetParam() * degree;
  const double step = 0.0007;
  for (const double wind : {1.0, -1.0}) {
    ShadowProfile profile = dipping(leaning(0.07, 0.0042), 0.38, step, dip);
    profile.downwind = wind;
    const auto a = analyse(profile);
    ASSERT_EQ(a.ripples.size(), 4u);
    for (std::size_t i = 0; i < a.ripples.size(); ++i) {
      const double troughs = 0.07 * std::cos(dip);
      EXPECT_NEAR(a.ripples[i].start, static_cast<double>(i + 1) * troughs, step);
      EXPECT_NEAR(a.ripples[i].end, static_cast<double>(i + 2) * troughs, step);
      EXPECT_NEAR(a.ripples[i].apparent_dip.value, wind * dip, 0.2 * degree);
      EXPECT_NEAR(a.ripples[i].height.value, 0.0042, 0.00002);
    }
    EXPECT_NEAR(a.apparent_dip.value, wind * dip, 0.2 * degree);
  }
}
INSTANTIATE_TEST_SUITE_P(Thesis, Dip, testing::Values(-10.4, -3.3, 0.0, 0.7, 6.1));

struct Surface {
  double dip, wavelength, stoss, lee, lee_to_horizontal;
};
class Table51 : public testing::TestWithParam<Surface> {};

// Row 10: Werner's table 5.1 as triangles of those angles, measured with the filter of a grain.
TEST_P(Table51, IsReproduced) {
  const Surface s = GetParam();
  ShadowProfile profile = dipping(triangles(s.wavelength, s.stoss * degree, s.lee * degree),
                                  4.6 * s.wavelength, grain, s.dip * degree);
  profile.grain_diameter = grain;
  profile.downwind = 1;
  const auto a = analyse(profile);
  ASSERT_EQ(a.ripples.size(), 3u);
  EXPECT_NEAR(a.wavelength.value, s.wavelength, 0.01 * s.wavelength);
  EXPECT_NEAR(a.stoss_max.value / degree, s.stoss, 1);
  EXPECT_NEAR(a.lee_max.value / degree, s.lee, 1);
  EXPECT_NEAR((-a.lee_max.value - a.apparent_dip.value) / degree, s.lee_to_horizontal, 1);
}
INSTANTIATE_TEST_SUITE_P(Thesis, Table51,
                         testing::Values(Surface{-10.4, 0.081, 5.3, 6.4, 4.0},
                                         Surface{-3.3, 0.068, 6.5, 16.8, -13.5},
                                         Surface{0.7, 0.073, 11.4, 23.5, -24.2},
                                         Surface{6.1, 0.067, 10.0, 20.9, -27.0}));

TEST(ProfileAnalysis, TheSteeperFlankIsTheLeeWhereTheWindIsNotKnown) {
  const Curve right = leaning(0.07, 0.0042);
  const auto a = analyse(profile_of(right, 0.3, grain));
  EXPECT_FALSE(a.downwind_known);
  EXPECT_EQ(a.downwind, 1);
  const auto b = analyse(profile_of([&](double x) { return right(-x); }, 0.3, grain));
  EXPECT_EQ(b.downwind, -1);
  EXPECT_NEAR(b.lee_max.value, a.lee_max.value, 0.3 * degree);
  EXPECT_GT(a.lee_max.value, a.stoss_max.value);
}

TEST(ProfileAnalysis, LengthsOfAWaveAgree) {
  ShadowProfile profile = profile_of(leaning(0.0517, 0.003), 0.4, grain);
  profile.grain_diameter = grain;
  add_noise(profile, 0.1e-3, 12);
  const auto a = analyse(profile);
  EXPECT_NEAR(a.wavelength.value, 0.0517, 0.005 * 0.0517);
  EXPECT_NEAR(a.dominant_length.value, 0.0517, 0.005 * 0.0517);
  EXPECT_NEAR(a.spectral_wavelength.value, 0.0517, 0.005 * 0.0517);
  EXPECT_NEAR(a.height.value, 0.003, 0.05e-3);
  ASSERT_EQ(a.even.z.size(), a.even.sigma_z.size());
  EXPECT_LT(a.even.sigma_z[500], 0.1e-3);
  EXPECT_GT(a.even.sigma_z[500], 0.02e-3);
  EXPECT_EQ(a.lag.size(), a.length_scale.size());
  EXPECT_EQ(a.wavenumber.size(), a.power.size());
}

// A hollow under the ripples, deeper than they are high: a hull of the whole profile would bridge
// the ripples of the hollow.
TEST(ProfileAnalysis, ALongWaveDoesNotHideRipples) {
  const Curve ripples = leaning(0.05, 0.003);
  const auto a = analyse(
      profile_of([&](double x) { return ripples(x) + 0.005 * std::cos(2 * M_PI * x / 0.6); }, 0.62, 0.0005));
  ASSERT_EQ(a.ripples.size(), 11u);
  for (const auto& ripple : a.ripples) EXPECT_NEAR(ripple.wavelength.value, 0.05, 0.002);
}

TEST(ProfileAnalysis, BumpsOnAStossBackAreNoRipples) {
  const Curve ripples = triangles(0.1, 4 * degree, 20 * degree);
  const auto a = analyse(profile_of(
      [&](double x) { return ripples(x) + 0.3e-3 * std::sin(2 * M_PI * x / 0.009); }, 0.45, grain));
  EXPECT_EQ(a.ripples.size(), 3u);
}

TEST(ProfileAnalysis, UnequalRipplesAreToldApart) {
  const auto bump = [](double x, double at, double height, double width) {
    return height * std::exp(-0.5 * (x - at) * (x - at) / (width * width));
  };
  ShadowProfile profile = profile_of(
      [&](double x) {
        return bump(x, 0.05, 0.004, 0.01) + bump(x, 0.09, 0.0015, 0.006) + bump(x, 0.14, 0.005, 0.012) +
               bump(x, 0.2, 0.004, 0.01);
      },
      0.25, grain);
  add_noise(profile, 0.05e-3, 3);
  profile.grain_diameter = grain;
  const auto a = analyse(profile);
  ASSERT_EQ(a.crests.size(), 4u);
  EXPECT_NEAR(a.crests[1], 0.09, 0.0015);
  ASSERT_GE(a.ripples.size(), 2u);
}

TEST(ProfileAnalysis, NoiseHasNoRipples) {
  int ripples = 0;
  for (std::uint64_t seed = 0; seed < 30; ++seed) {
    ShadowProfile profile = profile_of([](double) { return 0.0; }, 0.27, grain);
    profile.grain_diameter = grain;
    add_noise(profile, 0.5 * grain, seed);
    const auto a = analyse(profile);
    ripples += static_cast<int>(a.ripples.size());
    EXPECT_EQ(a.ripples.empty(), std::isnan(a.wavelength.value));
    EXPECT_GT(a.roughness.value, 0);
  }
  EXPECT_LE(ripples, 1);
}

TEST(ProfileAnalysis, AConstantOrTiltedPlaneHasNoFigures) {
  for (const double slope : {0.0, 0.1}) {
    for (const double d : {0.0, grain}) {
      ShadowProfile profile = profile_of([=](double x) { return 0.3 + slope * x; }, 0.2, grain);
      profile.grain_diameter = d;
      const auto a = analyse(profile);
      EXPECT_TRUE(a.ripples.empty());
      for (const Figure& f : {a.wavelength, a.height, a.index, a.stoss_mean, a.lee_max, a.apparent_dip,
                              a.dominant_length, a.spectral_wavelength})
        EXPECT_TRUE(std::isnan(f.value));
      EXPECT_NEAR(a.roughness.value, 0, 1e-12);
    }
  }
}

TEST(ProfileAnalysis, SurvivesGapsAndShortProfilesAndRefusesNothing) {
  ShadowProfile profile = profile_of(leaning(0.05, 0.003), 0.4, grain);
  add_noise(profile, 0.05e-3, 1);
  profile.grain_diameter = grain;
  for (std::size_t i = 0; i < profile.z.size(); i += 7) profile.z[i] = NAN;
  for (std::size_t i = 1200; i < 1300; ++i) profile.z[i] = NAN;
  const auto a = analyse(profile);
  EXPECT_NEAR(a.wavelength.value, 0.05, 0.001);
  EXPECT_LT(a.even.start + a.even.step * static_cast<double>(a.even.z.size()), 1201 * grain);

  EXPECT_NO_THROW(analyse(profile_of(leaning(0.05, 0.003), 8 * grain, grain)));
  EXPECT_THROW(analyse(profile_of(leaning(0.05, 0.003), 6 * grain, grain)), Error);
  EXPECT_THROW(analyse(ShadowProfile{}), Error);
  profile.z.assign(profile.z.size(), NAN);
  EXPECT_THROW(analyse(profile), Error);
  ShadowProfile still = profile_of(leaning(0.05, 0.003), 0.1, grain);
  still.x.assign(still.x.size(), 0.1);
  EXPECT_THROW(analyse(still), Error);
}

TEST(ProfileAnalysis, IsDecidedByItsInput) {
  ShadowProfile profile = profile_of(leaning(0.05, 0.003), 0.2, grain);
  add_noise(profile, 0.1e-3, 1);
  const auto a = analyse(profile);
  const auto b = analyse(profile);
  EXPECT_EQ(a.height.value, b.height.value);
  EXPECT_EQ(a.height.sigma, b.height.sigma);
}

}  // namespace
}  // namespace aeolian
