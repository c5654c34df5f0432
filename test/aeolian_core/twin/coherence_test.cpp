#include "aeolian_core/twin/coherence.hpp"

#include <cmath>

#include "noise_fields.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

const GridGeometry plot(0, 0, 0.01, 512, 128);

DirectionalLines lines_of(const HeightMap::Layer& z) { return DirectionalLines(plot, z, {}, 0); }

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

double share_above_level(const Coherence& c) {
  double above = 0;
  for (std::size_t i = 0; i < c.squared.size(); ++i) above += c.squared[i] > c.level95[i] ? 1 : 0;
  return above / static_cast<double>(c.squared.size());
}

/// The same value in each column: crests without end across the wind.
HeightMap::Layer long_crests(double sigma, std::uint64_t seed) {
  RandomStream random(seed, 5);
  HeightMap::Layer z(plot.size());
  for (int x = 0; x < plot.nx(); ++x) {
    const auto height = static_cast<float>(sigma * random.normal());
    for (int y = 0; y < plot.ny(); ++y) z[plot.index(x, y)] = height;
  }
  return z;
}

TEST(CoherenceTest, of_identical_lines_is_one) {
  const DirectionalLines lines = lines_of(white_noise(plot, 1, 1));
  for (const double squared : coherence(lines, lines, 0.01, 64).squared) EXPECT_EQ(squared, 1);
}

TEST(CoherenceTest, of_unrelated_surfaces_exceeds_its_level_in_five_percent) {
  double noise = 0;
  double crests = 0;
  constexpr int trials = 24;
  for (int i = 0; i < trials; ++i) {
    const auto seed = static_cast<std::uint64_t>(i);
    noise += share_above_level(coherence(lines_of(white_noise(plot, 1, seed)),
                                         lines_of(white_noise(plot, 1, 100 + seed)), 0.01, 64)) /
             trials;
    // Long crests make all lines one: 15 segments then, not 15 x 64.
    crests += share_above_level(
                  coherence(lines_of(long_crests(1, seed)), lines_of(long_crests(1, 100 + seed)), 0.01, 64)) /
              trials;
  }
  EXPECT_NEAR(noise, 0.05, 0.02);
  EXPECT_NEAR(crests, 0.05, 0.03);
}

TEST(CoherenceTest, of_a_signal_in_noise_is_that_of_its_share_whatever_the_shift) {
  // Signal of variance 1 in both, noise of variance s_a and s_b: 1 / ((1 + s_a) (1 + s_b)).
  const HeightMap::Layer signal = white_noise(plot, 1, 1);
  HeightMap::Layer a = white_noise(plot, std::sqrt(0.25), 2);
  HeightMap::Layer b = white_noise(plot, std::sqrt(0.5), 3);
  for (std::size_t i = 0; i < a.size(); ++i) {
    a[i] += signal[i];
    b[i] += signal[i];
  }
  const Coherence c = coherence(lines_of(a), lines_of(b), 0.01, 64);
  const double expected = 1 / (1.25 * 1.5);
  EXPECT_NEAR(mean(c.squared), expected, 0.02);
  double within = 0;
  for (std::size_t i = 0; i < c.squared.size(); ++i)
    within += std::abs(c.squared[i] - expected) < 1.96 * c.sigma[i] ? 1 : 0;
  EXPECT_GE(within / static_cast<double>(c.squared.size()), 0.8);
  EXPECT_NEAR(c.wavelength.back(), 0.02, 1e-12);
  EXPECT_NEAR(c.wavelength.front(), 0.32, 1e-12);
}

TEST(CoherenceTest, needs_two_independent_segments) {
  const DirectionalLines lines = lines_of(HeightMap::Layer(plot.size(), HeightMap::unknown));
  EXPECT_TRUE(coherence(lines, lines, 0.01, 64).squared.empty());
}

}  // namespace
}  // namespace aeolian
