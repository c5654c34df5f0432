#include "aeolian_core/twin/difference.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/twin/quantile.hpp"

namespace aeolian {
namespace {

TEST(Difference, ClosedForms) {
  // 1, 1, 2, 2, 4, 6, 9 is the textbook sample with median 2 and median absolute deviation 1.
  const HeightMap::Layer a{1, 1, 2, 2, 4, 6, 9};
  const HeightMap::Layer b(7, 0);
  const DifferenceStatistics s = difference_statistics(a, b);
  EXPECT_EQ(s.cells, 7U);
  EXPECT_DOUBLE_EQ(s.bias, 25.0 / 7);
  EXPECT_DOUBLE_EQ(s.rmse, std::sqrt(143.0 / 7));
  EXPECT_DOUBLE_EQ(s.nmad, 1.4826);
}

TEST(Difference, NmadDoesNotFeelAnOutlierOrABias) {
  HeightMap::Layer a{1, 2, 3, 4, 5};
  const HeightMap::Layer b(5, 0);
  const double nmad = difference_statistics(a, b).nmad;
  EXPECT_DOUBLE_EQ(nmad, 1.4826);
  a[4] = 1000;
  EXPECT_DOUBLE_EQ(difference_statistics(a, b).nmad, nmad);
  for (float& v : a) v += 10;
  EXPECT_DOUBLE_EQ(difference_statistics(a, b).nmad, nmad);
}

TEST(Difference, UnknownCellsAreLeftOut) {
  const HeightMap::Layer a{1, HeightMap::unknown, 3};
  const HeightMap::Layer b{0, 0, HeightMap::unknown};
  const DifferenceStatistics s = difference_statistics(a, b);
  EXPECT_EQ(s.cells, 1U);
  EXPECT_EQ(s.bias, 1);
  const HeightMap::Layer d = difference(a, b);
  EXPECT_EQ(d[0], 1);
  EXPECT_TRUE(std::isnan(d[1]) && std::isnan(d[2]));
}

TEST(Difference, NothingInCommonGivesNaN) {
  const DifferenceStatistics s = difference_statistics({HeightMap::unknown}, {1});
  EXPECT_EQ(s.cells, 0U);
  EXPECT_TRUE(std::isnan(s.bias) && std::isnan(s.rmse) && std::isnan(s.nmad));
  EXPECT_THROW(difference_statistics({1, 2}, {1}), Error);
  EXPECT_THROW(difference({1, 2}, {1}), Error);
}

TEST(Quantile, LinearBetweenOrderStatistics) {
  std::vector<double> sample{4, 1, 3, 2};
  EXPECT_DOUBLE_EQ(quantile(sample, 0.5), 2.5);
  EXPECT_DOUBLE_EQ(quantile(sample, 0.25), 1.75);
  EXPECT_DOUBLE_EQ(quantile(sample, 0), 1);
  EXPECT_DOUBLE_EQ(quantile(sample, 1), 4);
  std::vector<double> infinite{-INFINITY, -INFINITY, 1};
  EXPECT_EQ(quantile(infinite, 0.25), -INFINITY);
  std::vector<double> none;
  EXPECT_TRUE(std::isnan(quantile(none, 0.5)));
}

// With ties, unknown values, constant, and in an order that misleads the probe.
TEST(Quantile, IsTheSameWithoutStoringALargeSample) {
  constexpr std::size_t count = 200000;
  const auto expect_same = [&](auto value) {
    std::vector<double> known;
    for (std::size_t i = 0; i < count; ++i)
      if (!std::isnan(value(i))) known.push_back(value(i));
    for (const double share : {0.0, 0.1, 0.5, 0.7301, 1.0}) {
      std::vector<double> sample = known;
      EXPECT_EQ(quantile_of(count, known.size(), share, value), quantile(sample, share)) << share;
    }
  };
  const auto scrambled = [](std::size_t i) { return static_cast<double>(i * 7919 % 200003); };
  expect_same(scrambled);
  expect_same([&](std::size_t i) { return std::floor(scrambled(i) / 1000); });
  expect_same([&](std::size_t i) { return i % 3 == 0 ? NAN : scrambled(i); });
  expect_same([](std::size_t) { return 4.0; });
  expect_same([&](std::size_t i) { return i * 16384 % 200000 < 16384 ? 0.0 : scrambled(i); });
}

}  // namespace
}  // namespace aeolian
