#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/measure/profile_analysis.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

double deviation(const std::vector<double>& values) {
  double squares = 0;
  for (const double v : values) squares += v * v;
  return std::sqrt(squares / static_cast<double>(values.size()));
}

std::vector<double> white_noise(double sigma) {
  RandomStream random(51, 0);
  std::vector<double> noise(100000);
  for (double& v : noise) v = sigma * random.normal();
  return noise;
}

// Werner's filter with sigma one grain: what it leaves of noise (specification, row 7).
TEST(ValueWeightedSmoothing, ReducesNoiseAsMuchAsItShould) {
  EXPECT_NEAR(deviation(value_weighted_smoothing(white_noise(1), 1)), 0.64, 0.02);
  EXPECT_NEAR(deviation(value_weighted_smoothing(white_noise(0.5), 1)) / 0.5, 0.38, 0.02);
}

TEST(ValueWeightedSmoothing, KeepsAStepOfFiveSigma) {
  std::vector<double> step(40, 0.0);
  for (std::size_t i = 20; i < step.size(); ++i) step[i] = 5;
  const auto smooth = value_weighted_smoothing(step, 1);
  EXPECT_NEAR(smooth[20] - smooth[19], 5, 0.02 * 5);
}

TEST(ValueWeightedSmoothing, KeepsASlopeToItsEnds) {
  std::vector<double> slope;
  for (int i = 0; i < 30; ++i) slope.push_back(0.4 * i);
  const auto smooth = value_weighted_smoothing(slope, 1);
  for (std::size_t i = 0; i < slope.size(); ++i) EXPECT_NEAR(smooth[i], slope[i], 1e-6);
}

TEST(ValueWeightedSmoothing, EqualsTheFormula) {
  const auto noise = white_noise(1);
  const std::vector<double> v(noise.begin(), noise.begin() + 50);
  const auto smooth = value_weighted_smoothing(v, 0.7, 3);
  for (int i = 3; i < 47; ++i) {
    double sum = 0;
    double weights = 0;
    for (int j = i - 3; j <= i + 3; ++j) {
      const double d = v[static_cast<std::size_t>(j)] - v[static_cast<std::size_t>(i)];
      const double w = std::exp(-d * d / (2 * 0.7 * 0.7));
      sum += w * v[static_cast<std::size_t>(j)];
      weights += w;
    }
    EXPECT_NEAR(smooth[static_cast<std::size_t>(i)], sum / weights, 1e-6);
  }
}

TEST(ValueWeightedSmoothing, TakesTheSmallestInputsAndRefusesNonsense) {
  EXPECT_EQ(value_weighted_smoothing({}, 1), std::vector<double>{});
  EXPECT_EQ(value_weighted_smoothing({3}, 1), std::vector<double>{3});
  EXPECT_EQ(value_weighted_smoothing({1, 2, 4}, 0), (std::vector<double>{1, 2, 4}));
  EXPECT_THROW(value_weighted_smoothing({1, 2, 4}, -1), Error);
  EXPECT_THROW(value_weighted_smoothing({1, 2, 4}, 1, -1), Error);
}

}  // namespace
}  // namespace aeolian
