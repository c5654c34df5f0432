#include "aeolian_core/measure/ripple_statistics.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

/// A surface h(s), s along a direction [m], on a tilted plane.
template <class Profile>
HeightMap::Layer along(const GridGeometry& g, double direction, Profile&& profile) {
  HeightMap::Layer layer(g.size());
  for (int iy = 0; iy < g.ny(); ++iy)
    for (int ix = 0; ix < g.nx(); ++ix) {
      const double s = std::cos(direction) * g.x(ix) + std::sin(direction) * g.y(iy);
      layer[g.index(ix, iy)] = static_cast<float>(profile(s) + 0.3 + 0.02 * g.x(ix) - 0.01 * g.y(iy));
    }
  return layer;
}

const GridGeometry plot(0, 0, 0.002, 500, 500);

class Sinusoid : public testing::TestWithParam<double> {};

TEST_P(Sinusoid, HasItsWavelengthAndHeight) {
  const double direction = GetParam() * degree;
  for (const double wavelength : {0.02, 0.05, 0.0731}) {
    const double height = wavelength / 15;
    const auto layer =
        along(plot, direction, [&](double s) { return 0.5 * height * std::sin(2 * M_PI * s / wavelength); });
    const auto r = ripple_statistics(plot, layer, direction);
    EXPECT_NEAR(r.wavelength, wavelength, 0.01 * wavelength);
    EXPECT_NEAR(r.height, height, 0.01 * height);
    EXPECT_NEAR(r.index, 15, 0.3);
    EXPECT_GT(r.significance, 0.95);
  }
}
INSTANTIATE_TEST_SUITE_P(Directions, Sinusoid, testing::Values(0.0, 30.0, 90.0, -145.0, 180.0));

// The median of |cos| is cos 45 degrees. The wavelength is no whole number of cells, so that all phases are
// met.
TEST(RippleStatistics, SlopesOfASinusoidAreAnalytic) {
  const double wavelength = 0.0731;
  const double height = wavelength / 15;
  const double slope = std::atan(M_PI / 15 * std::sqrt(0.5));
  for (const double direction : {0.0, 30 * degree, 90 * degree}) {
    const auto r = ripple_statistics(
        plot,
        along(plot, direction, [&](double s) { return 0.5 * height * std::sin(2 * M_PI * s / wavelength); }),
        direction);
    EXPECT_NEAR(r.stoss_slope, slope, 0.03 * slope);
    EXPECT_NEAR(r.lee_slope, slope, 0.03 * slope);
  }
}

// Triangles that rise over 80 % of the wavelength.
TEST(RippleStatistics, TellsStossFromLee) {
  const double wavelength = 0.1;
  const double height = 0.006;
  const auto profile = [&](double s) {
    const double phase = s / wavelength - std::floor(s / wavelength);
    return height * (phase < 0.8 ? phase / 0.8 : (1 - phase) / 0.2);
  };
  const double stoss = std::atan(height / (0.8 * wavelength));
  const double lee = std::atan(height / (0.2 * wavelength));
  const auto downwind = ripple_statistics(plot, along(plot, 0, profile), 0);
  EXPECT_NEAR(downwind.stoss_slope, stoss, 0.05 * stoss);
  EXPECT_NEAR(downwind.lee_slope, lee, 0.05 * lee);
  const auto upwind = ripple_statistics(plot, along(plot, 0, profile), M_PI);
  EXPECT_NEAR(upwind.stoss_slope, lee, 0.05 * lee);
  EXPECT_NEAR(upwind.lee_slope, stoss, 0.05 * stoss);
}

TEST(RippleStatistics, FindsNothingInNoise) {
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    RandomStream random(seed, 0);
    HeightMap::Layer layer(plot.size());
    for (float& h : layer) h = static_cast<float>(0.001 * random.normal());
    const auto r = ripple_statistics(plot, layer, 0.3);
    EXPECT_TRUE(std::isnan(r.wavelength) && std::isnan(r.height) && std::isnan(r.lee_slope)) << seed;
  }
}

TEST(RippleStatistics, FindsNothingOnALevelEmptyOrTooShortMap) {
  EXPECT_TRUE(std::isnan(ripple_statistics(plot, HeightMap::Layer(plot.size(), 0.1F), 0).wavelength));
  EXPECT_TRUE(
      std::isnan(ripple_statistics(plot, HeightMap::Layer(plot.size(), HeightMap::unknown), 0).wavelength));
  const auto layer = along(plot, 0, [](double s) { return 0.01 * std::sin(2 * M_PI * s / 0.6); });
  EXPECT_TRUE(std::isnan(ripple_statistics(plot, layer, 0).wavelength));
  const GridGeometry one(0, 0, 1, 1, 1);
  EXPECT_TRUE(std::isnan(ripple_statistics(one, {0.F}, 0).wavelength));
}

// Half of the cells unknown, half a noisy millimetre on ripples of 3 mm.
TEST(RippleStatistics, StandsNoiseAndUnknownCells) {
  const double wavelength = 0.05;
  auto layer = along(plot, 0, [&](double s) { return 0.0015 * std::sin(2 * M_PI * s / wavelength); });
  RandomStream random(3, 0);
  for (float& h : layer) {
    h += static_cast<float>(0.0005 * random.normal());
    if (random.uniform() < 0.5) h = HeightMap::unknown;
  }
  const auto r = ripple_statistics(plot, layer, 0);
  EXPECT_NEAR(r.wavelength, wavelength, 0.01 * wavelength);
  EXPECT_NEAR(r.height, 2 * std::sqrt(2 * (0.0015 * 0.0015 / 2 + 0.0005 * 0.0005)), 3e-5);
}

TEST(RippleStatistics, RefusesALayerOfAnotherGrid) {
  EXPECT_THROW(ripple_statistics(plot, HeightMap::Layer(5), 0), Error);
  EXPECT_THROW(ripple_statistics(plot, HeightMap::Layer(plot.size()), std::nan("")), Error);
}

}  // namespace
}  // namespace aeolian
