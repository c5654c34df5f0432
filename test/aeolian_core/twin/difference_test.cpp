#include "aeolian_core/twin/difference.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"
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
TEST(Quantile, IsTheSameWithoutSortingALargeSample) {
  constexpr std::size_t count = 200005;
  const auto expect_same = [&](auto value) {
    std::vector<float> values;
    std::vector<double> known;
    std::vector<double> distances;
    for (std::size_t i = 0; i < count; ++i) {
      values.push_back(static_cast<float>(value(i)));
      if (std::isnan(values.back())) continue;
      known.push_back(static_cast<double>(values.back()));
      distances.push_back(std::abs(known.back() - 70000.5));
    }
    for (const double share : {0.0, 0.1, 0.5, 0.7301, 1.0}) {
      std::vector<double> sample = known;
      EXPECT_EQ(quantile_of(values, known.size(), share), quantile(sample, share)) << share;
      sample = distances;
      EXPECT_EQ(quantile_of_distances(values, known.size(), share, 70000.5), quantile(sample, share))
          << share;
    }
  };
  const auto scrambled = [](std::size_t i) { return static_cast<double>(i * 7919 % 200003); };
  expect_same(scrambled);
  expect_same([&](std::size_t i) { return std::floor(scrambled(i) / 1000); });
  expect_same([&](std::size_t i) { return i % 3 == 0 ? NAN : scrambled(i); });
  expect_same([](std::size_t) { return 4.0; });
  expect_same([&](std::size_t i) { return i * 16384 % 200000 < 16384 ? 0.0 : scrambled(i); });
  expect_same([](std::size_t i) { return static_cast<double>(i); });
  expect_same([](std::size_t i) { return std::sin(0.001 * static_cast<double>(i)); });
}

/// Two surveys of 300 x 200 cells of 0.5 m, with errors of 3 and 4 cm, and what lies between them.
class LevelOfDetection : public testing::Test {
 protected:
  template <class Height>
  static HeightMap survey(double sigma, std::uint64_t stream, Height&& height) {
    HeightMap map(GridGeometry(0, 0, 0.5, 300, 200));
    HeightMap::Layer& z = map.add(layer::elevation);
    RandomStream random(3, stream);
    for (std::size_t i = 0; i < z.size(); ++i)
      z[i] = static_cast<float>(height(map.geometry().cell_at(i)) + sigma * random.normal());
    map.add(layer::variance, static_cast<float>(sigma * sigma));
    return map;
  }
  static double level(CellIndex) { return 1; }
};

TEST_F(LevelOfDetection, LeavesFivePercentOfABedThatRests) {
  const HeightMap d = difference_map(survey(0.03, 1, level), survey(0.04, 2, level));
  EXPECT_NEAR(static_cast<double>(d.layer(layer::lod95)[7]), 1.96 * 0.05, 1e-7);
  const SignificantChange change = significant_change(d);
  EXPECT_NEAR(static_cast<double>(change.cells) / 60000, 0.05, 4 * std::sqrt(0.05 * 0.95 / 60000));
  EXPECT_NEAR(change.area, 0.25 * static_cast<double>(change.cells), 1e-9);
}

TEST_F(LevelOfDetection, FindsVolumesWithinTheirUncertainty) {
  const auto moved = [](CellIndex at) { return at.x < 100 ? 1.4 : at.x >= 250 ? 0.2 : 1.0; };
  std::vector<double> off;
  for (std::uint64_t k = 0; k < 40; ++k) {
    const HeightMap before = survey(0.03, 100 + k, level);
    HeightMap after = survey(0.04, 200 + k, moved);
    for (int y = 0; y < 200; ++y)  // nothing there, so that only what was moved on purpose counts
      for (int x = 100; x < 250; ++x)
        after.layer(layer::elevation)[after.geometry().index(x, y)] = HeightMap::unknown;
    const SignificantChange change = significant_change(difference_map(after, before));
    EXPECT_EQ(change.cells, 30000U);
    off.push_back((change.deposition - 0.25 * 20000 * 0.4) / change.deposition_sigma);
    off.push_back((change.erosion - 0.25 * 10000 * 0.8) / change.erosion_sigma);
    EXPECT_NEAR(change.deposition_sigma, 0.25 * 0.05 * std::sqrt(20000), 1e-6);
  }
  double squares = 0;
  for (const double d : off) squares += d * d;
  EXPECT_NEAR(squares / 80, 1, 4 * std::sqrt(2.0 / 80));
}

TEST_F(LevelOfDetection, TakesAMapWithoutVarianceAsExact) {
  HeightMap forecast = survey(0, 1, level);
  forecast.remove(layer::variance);
  HeightMap measured = survey(0.03, 2, level);
  measured.layer(layer::variance)[5] = HeightMap::unknown;
  const HeightMap d = difference_map(forecast, measured);
  EXPECT_NEAR(static_cast<double>(d.layer(layer::lod95)[0]), 1.96 * 0.03, 1e-7);
  EXPECT_TRUE(std::isnan(d.layer(layer::lod95)[5]));
  measured.remove(layer::variance);
  EXPECT_FALSE(difference_map(forecast, measured).has(layer::lod95));
  EXPECT_THROW(significant_change(difference_map(forecast, measured)), Error);
  EXPECT_THROW(difference_map(measured, HeightMap(GridGeometry(0, 0, 0.5, 200, 300))), Error);
}

TEST_F(LevelOfDetection, IsTheSameInTheMemoryOfAnotherMap) {
  const HeightMap forecast = survey(0.02, 1, level);
  const HeightMap measured = survey(0.03, 2, level);
  const HeightMap fresh = difference_map(forecast, measured);
  HeightMap small(GridGeometry(0, 0, 1, 3, 2));
  small.add(layer::difference, 7);
  small.add(layer::elevation, 7);
  for (const HeightMap& old : {small, difference_map(measured, survey(0.5, 3, level))}) {
    const HeightMap again = difference_map(forecast, measured, old);
    EXPECT_EQ(again.geometry(), fresh.geometry());
    EXPECT_EQ(again.names(), fresh.names());
    for (const std::string& name : fresh.names()) EXPECT_EQ(again.layer(name), fresh.layer(name)) << name;
  }
}

}  // namespace
}  // namespace aeolian
