#include "aeolian_core/surface/unseen_changes.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const GridGeometry grid(0, 0, 0.002, 200, 150);  // 7 x 5 tiles
constexpr double sigma = 0.001;
const TileMask all(grid, true);

HeightMap known(float height, double deviation = sigma) {
  HeightMap map(grid);
  map.add(layer::elevation, height);
  map.add(layer::variance, static_cast<float>(deviation * deviation));
  return map;
}

/// Root mean square of (z - receiver's z) / receiver's standard deviation over the cells of each tile.
double worst_departure(const HeightMap& map, const HeightMap& receiver) {
  double worst = 0;
  all.for_each([&](const CellRange& tile) {
    double sum = 0;
    int cells = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        const std::size_t i = grid.index(x, y);
        const auto d =
            static_cast<double>(map.layer(layer::elevation)[i] - receiver.layer(layer::elevation)[i]);
        sum += d * d / static_cast<double>(receiver.layer(layer::variance)[i]);
        ++cells;
      }
    }
    worst = std::max(worst, std::sqrt(sum / cells));
  });
  return worst;
}

void hand_out(const HeightMap& map, const TileMask& tiles, HeightMap& receiver) {
  for (const std::string& name : map.names())
    tiles.for_each([&](const CellRange& tile) {
      for (int y = tile.y0; y < tile.y1; ++y)
        for (int x = tile.x0; x < tile.x1; ++x)
          receiver.layer(name)[grid.index(x, y)] = map.layer(name)[grid.index(x, y)];
    });
}

TEST(UnseenChanges, HandsOutWhatIsKnownOnceAndOnlyWhatWasTouched) {
  UnseenChanges unseen(grid);
  EXPECT_TRUE(unseen.take(known(HeightMap::unknown), all).empty()) << "nobody knows anything";
  TileMask one(grid);
  one.set_tile(6, 4);
  EXPECT_EQ(unseen.take(known(1), one).count(), 1);
  EXPECT_EQ(unseen.take(known(1), all).count(), 34);
  EXPECT_TRUE(unseen.take(known(1), all).empty());
}

TEST(UnseenChanges, HandsOutATileWithACellThatBecameKnownOrUnknown) {
  UnseenChanges unseen(grid);
  HeightMap map = known(1);
  unseen.take(map, all);
  float& cell = map.layer(layer::elevation)[grid.index(199, 149)];
  for (const float value : {HeightMap::unknown, 1.0F}) {
    cell = value;
    const TileMask taken = unseen.take(map, all);
    EXPECT_EQ(taken.count(), 1);
    EXPECT_TRUE(taken.tile(6, 4));
  }
}

TEST(UnseenChanges, HandsOutASingleCellBeyondFiveSigma) {
  UnseenChanges unseen(grid);
  HeightMap map = known(0);
  unseen.take(map, all);
  const double both = std::sqrt(2) * sigma;
  map.layer(layer::elevation)[grid.index(40, 40)] = static_cast<float>(4.9 * both);
  EXPECT_TRUE(unseen.take(map, all).empty());
  map.layer(layer::elevation)[grid.index(40, 40)] = static_cast<float>(-5.1 * both);
  EXPECT_EQ(unseen.take(map, all).count(), 1);
}

TEST(UnseenChanges, HandsOutAnotherUncertainty) {
  UnseenChanges unseen(grid);
  unseen.take(known(0), all);
  EXPECT_TRUE(unseen.take(known(0, sigma * std::sqrt(0.51)), all).empty());
  EXPECT_EQ(unseen.take(known(0, sigma * std::sqrt(0.49)), all).count(), 35);
  EXPECT_TRUE(unseen.take(known(0, sigma * std::sqrt(0.97)), all).empty());
  EXPECT_EQ(unseen.take(known(0, sigma), all).count(), 35);
}

TEST(UnseenChanges, AStillNoisyBedIsHandedOutWithLogarithmicFrequency) {
  UnseenChanges unseen(grid);
  HeightMap map = known(0);
  HeightMap receiver = known(HeightMap::unknown);
  std::vector<double> sums(grid.size(), 0);
  RandomStream random(11, 0);
  int handed_out = 0;
  int in_the_last_half = 0;
  constexpr int scans = 100;
  for (int n = 1; n <= scans; ++n) {
    for (std::size_t i = 0; i < sums.size(); ++i) {
      sums[i] += sigma * random.normal();
      map.layer(layer::elevation)[i] = static_cast<float>(sums[i] / n);
      map.layer(layer::variance)[i] = static_cast<float>(sigma * sigma / n);
    }
    const TileMask taken = unseen.take(map, all);
    hand_out(map, taken, receiver);
    handed_out += taken.count();
    if (n > scans / 2) in_the_last_half += taken.count();
    EXPECT_LE(worst_departure(map, receiver), 0.5 + 1e-4);
  }
  // The departure of a mean of n from that of m scans is 1 - m / n variances: each third more is notable.
  const double expected = 35 * (1 + std::log(scans) / std::log(4.0 / 3));
  EXPECT_LT(handed_out, 1.05 * expected);
  EXPECT_LT(in_the_last_half, 35 * 3.5);
}

TEST(UnseenChanges, ASlowDriftIsHandedOutWhenItHasBecomeNotable) {
  UnseenChanges unseen(grid);
  HeightMap receiver = known(HeightMap::unknown);
  int handed_out = 0;
  double farthest = 0;
  constexpr double step = 0.01 * sigma;
  for (int n = 0; n <= 1000; ++n) {
    const HeightMap map = known(static_cast<float>(n * step));
    const TileMask taken = unseen.take(map, all);
    hand_out(map, taken, receiver);
    handed_out += taken.count();
    farthest = std::max(farthest, worst_departure(map, receiver));
  }
  EXPECT_NEAR(handed_out / 35, 1 + 1000 / 51, 1) << "each time that it has moved by half a sigma";
  EXPECT_LE(farthest, 0.5 + 1e-3);
  EXPECT_GT(farthest, 0.48);
}

TEST(UnseenChanges, KeepsAMapWithoutAnyUncertainty) {
  UnseenChanges unseen(grid);
  EXPECT_EQ(unseen.take(known(1, 0), all).count(), 35);
  EXPECT_TRUE(unseen.take(known(1, 0), all).empty());
  EXPECT_EQ(unseen.take(known(1.0001F, 0), all).count(), 35);
}

TEST(UnseenChanges, RefusesAnotherGridAndAMapWithoutVariance) {
  UnseenChanges unseen(GridGeometry(0, 0, 0.002, 200, 151));
  EXPECT_THROW(unseen.take(known(0), all), Error);
  UnseenChanges fitting(grid);
  EXPECT_THROW(fitting.take(known(0), TileMask(GridGeometry(0, 0, 1, 9, 9), true)), Error);
  HeightMap map(grid);
  map.add(layer::elevation, 0);
  EXPECT_THROW(fitting.take(map, all), Error);
}

}  // namespace
}  // namespace aeolian
