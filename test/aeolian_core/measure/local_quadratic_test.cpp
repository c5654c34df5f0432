#include "aeolian_core/measure/local_quadratic.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/measure/continuous_part.hpp"

namespace aeolian {
namespace {

double parabola(double x) { return 3 - 2 * x + 0.7 * x * x; }

TEST(LocalQuadratic, KeepsAParabola) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 60; ++i)
    x.push_back(0.1 * i + 0.03 * std::sin(7.0 * i)), y.push_back(parabola(x.back()));
  const LocalQuadratic result = local_quadratic(x, y, 1);
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_NEAR(result.fit[i], y[i], 1e-9);
    EXPECT_NEAR(result.slope[i], -2 + 1.4 * x[i], 1e-8);
  }
}

TEST(LocalQuadratic, OutliersAndGapsDoNotCount) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 80; ++i)
    x.push_back(0.1 * i), y.push_back(parabola(x.back()) + 0.1 * std::sin(12.9898 * i * i));
  y[30] += 2;
  y[50] = NAN;
  const LocalQuadratic result = local_quadratic(x, y, 0.8);
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (i == 50) continue;
    EXPECT_NEAR(result.fit[i], parabola(x[i]), 0.2) << i;
  }
  EXPECT_TRUE(std::isnan(result.fit[50]));
  EXPECT_EQ(result.robust_weight[30], 0);
}

TEST(LocalQuadratic, TooFewNeighboursGiveNothing) {
  const LocalQuadratic result = local_quadratic({0, 1, 2, 3, 50}, {1, 1, 1, 1, 1}, 5);
  EXPECT_TRUE(std::isnan(result.fit[4]));
}

TEST(ContinuousPart, AJumpEndsItAndReachableRunsBelongToIt) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 60; ++i) {
    x.push_back(i);
    y.push_back(i >= 20 && i < 32 ? 100 : 0.2 * i);  // a stretch of something else
  }
  y[45] = NAN;
  const auto part = continuous_part(x, y, 0.5, 0.1);
  for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i], (i < 20 || i >= 32) && i != 45) << i;
}

TEST(ContinuousPart, ShortRunsAreDropped) {
  std::vector<double> x;
  std::vector<double> y;
  for (int i = 0; i < 40; ++i) x.push_back(i), y.push_back(0);
  for (const std::size_t i : {10u, 15u}) y[i] = 50;  // four values stand alone between them
  const auto part = continuous_part(x, y, 0.5, 0.1);
  EXPECT_TRUE(part[30]);
  EXPECT_FALSE(part[10]);
  EXPECT_FALSE(part[12]);
}

}  // namespace
}  // namespace aeolian
