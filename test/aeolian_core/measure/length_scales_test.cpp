#include "aeolian_core/measure/length_scales.hpp"

#include <algorithm>
#include <cmath>

#include "synthetic_profile.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

using namespace synthetic;

constexpr double step = 0.002;
constexpr double alike = 0.00075;

/// The developing bed of the specification, row 8: a sine of 0.2 cm amplitude and 7 cm, 226 samples.
EvenProfile sine(double noise, std::uint64_t seed) {
  RandomStream random(seed, 0);
  EvenProfile profile{0, step, {}, {}};
  for (int i = 0; i < 226; ++i)
    profile.z.push_back(0.002 * std::sin(2 * M_PI * i * step / 0.07) + noise * random.normal());
  return profile;
}

std::size_t highest_between(const std::vector<double>& f, std::size_t from, std::size_t to) {
  return static_cast<std::size_t>(std::max_element(f.begin() + static_cast<std::ptrdiff_t>(from) - 1,
                                                   f.begin() + static_cast<std::ptrdiff_t>(to)) -
                                  f.begin()) +
         1;
}

TEST(LengthScales, ReproduceThePublishedSine) {
  const LengthScales scales(detrended(sine(0, 1)), alike);
  const auto f = scales.distribution(125);
  ASSERT_EQ(f.size(), 125u);
  double mean = 0;
  for (const double v : f) mean += v / 125;
  EXPECT_NEAR(mean, 1, 1e-9);
  for (const std::size_t lag : {35u, 70u, 105u}) {
    const std::size_t top = highest_between(f, lag - 10, lag + 10);
    EXPECT_NEAR(static_cast<double>(top) * step, static_cast<double>(lag) * step, 0.002);
    EXPECT_NEAR(f[top - 1], 2.88, 0.02);
  }
  EXPECT_NEAR(*std::min_element(f.begin(), f.end()), 0.41, 0.02);
  const auto length = scales.dominant(f);
  ASSERT_TRUE(length);
  EXPECT_NEAR(*length * step, 0.07, 0.0005);
}

TEST(LengthScales, NoiseLowersThePeakAsPublished) {
  double height = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const LengthScales scales(detrended(sine(0.0005, seed)), alike);
    const auto f = scales.distribution(125);
    height += f[highest_between(f, 25, 45) - 1] / 20;
    const auto length = scales.dominant(f);
    ASSERT_TRUE(length);
    EXPECT_NEAR(*length * step, 0.07, 0.002);
  }
  EXPECT_NEAR(height, 2.4, 0.1);
}

TEST(LengthScales, NoiseAloneRepeatsNowhere) {
  int found = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    RandomStream random(seed, 0);
    std::vector<double> noise(226);
    for (double& z : noise) z = 0.0005 * random.normal();
    const LengthScales scales(noise, 0.0005);
    found += scales.dominant(scales.distribution(125)).has_value();
  }
  EXPECT_LE(found, 2);
}

}  // namespace
}  // namespace aeolian
