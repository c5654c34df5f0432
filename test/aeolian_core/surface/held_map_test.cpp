#include "aeolian_core/surface/held_map.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const GridGeometry grid(512345, 5401234, 0.01, 100, 70);  // 4 x 3 tiles
const float nan = HeightMap::unknown;

HeightMap rough(const GridGeometry& geometry = grid, std::uint64_t seed = 1) {
  HeightMap map(geometry);
  RandomStream random(seed, 0);
  for (const std::string& name : {layer::elevation, layer::variance})
    for (float& v : map.add(name)) v = random.uniform() < 0.1 ? nan : static_cast<float>(random.normal());
  return map;
}

bool same(const HeightMap& a, const HeightMap& b) {
  return a.geometry() == b.geometry() && a.names() == b.names() &&
         differing_tiles(a, {0, a.geometry().nx(), 0, a.geometry().ny()}, b).empty();
}

TEST(DifferingTiles, AreThoseWithAnotherValueInAnyLayer) {
  const HeightMap map = rough();
  HeightMap other = map;
  EXPECT_TRUE(differing_tiles(map, {0, 100, 0, 70}, other).empty());
  other.layer(layer::elevation)[grid.index(99, 69)] += 1;
  other.layer(layer::variance)[grid.index(32, 0)] = -9;
  const TileMask differing = differing_tiles(map, {0, 100, 0, 70}, other);
  EXPECT_EQ(differing.count(), 2);
  EXPECT_TRUE(differing.tile(3, 2) && differing.tile(1, 0));
  EXPECT_EQ(differing_tiles(submap(map, {33, 100, 0, 69}), {33, 100, 0, 69}, other).count(), 0)
      << "neither cell is in the part";
}

TEST(DifferingTiles, TakesAllNaNsAndBothZerosForTheSame) {
  HeightMap map(GridGeometry(0, 0, 1, 3, 1));
  map.add(layer::elevation, {nan, 0.0F, 1});
  HeightMap other(GridGeometry(0, 0, 1, 3, 1));
  other.add(layer::elevation, {std::nanf("7"), -0.0F, 1});
  EXPECT_TRUE(differing_tiles(map, {0, 3, 0, 1}, other).empty());
  other.layer(layer::elevation)[2] = nan;
  EXPECT_FALSE(differing_tiles(map, {0, 3, 0, 1}, other).empty());
}

TEST(DifferingTiles, RefusesAPlaceThatDoesNotFit) {
  EXPECT_THROW(differing_tiles(rough(), {0, 99, 0, 70}, rough()), Error);
  EXPECT_THROW(differing_tiles(rough(), {1, 101, 0, 70}, rough()), Error);
}

TEST(HeldMap, TellsTheTilesOfAWholeMapThatDiffer) {
  HeldMap held;
  EXPECT_FALSE(held.known());
  EXPECT_EQ(held.take_whole(rough(), seconds(1))->count(), 12) << "all are new";
  EXPECT_TRUE(held.known());
  EXPECT_TRUE(held.take_whole(rough(), seconds(2))->empty());
  HeightMap moved = rough();
  moved.layer(layer::elevation)[grid.index(40, 40)] = 7;
  const auto changed = held.take_whole(moved, seconds(3));
  EXPECT_EQ(changed->count(), 1);
  EXPECT_TRUE(changed->tile(1, 1));
  EXPECT_TRUE(same(held.map(), moved));
  EXPECT_EQ(held.stamp(), seconds(3));
}

TEST(HeldMap, TakesAnotherGridAndOtherLayersAsAllNew) {
  HeldMap held;
  held.take_whole(rough(), seconds(1));
  const GridGeometry shifted(grid.origin_x() + 0.01, grid.origin_y(), grid.cell(), grid.nx(), grid.ny());
  EXPECT_EQ(held.take_whole(rough(shifted), seconds(2))->count(), 12);
  HeightMap more = rough(shifted);
  more.add("rate", 0);
  EXPECT_EQ(held.take_whole(more, seconds(3))->count(), 12);
  EXPECT_TRUE(held.map().has("rate"));
}

TEST(HeldMap, PutsPartsInTheirPlaces) {
  HeldMap held;
  held.take_whole(rough(), seconds(1));
  const HeightMap next = rough(grid, 2);
  const auto changed = held.take_part(submap(next, {32, 100, 0, 32}), seconds(2));
  EXPECT_EQ(rectangles(*changed), (std::vector<CellRange>{{32, 100, 0, 32}}));
  EXPECT_TRUE(held.take_part(submap(next, {32, 64, 0, 32}), seconds(3))->empty());
  EXPECT_EQ(held.stamp(), seconds(3));
  HeightMap expected = rough();
  paste(submap(next, {32, 100, 0, 32}), {32, 100, 0, 32}, expected);
  EXPECT_TRUE(same(held.map(), expected));
}

TEST(HeldMap, IgnoresAWholeMapThatPartsHaveOvertaken) {
  HeldMap held;
  held.take_whole(rough(), seconds(100));
  const HeightMap next = rough(grid, 2);
  held.take_part(submap(next, {0, 32, 0, 32}), seconds(102));
  EXPECT_FALSE(held.take_whole(rough(), seconds(101)));
  EXPECT_EQ(held.map().layer(layer::variance)[0], next.layer(layer::variance)[0]);
  EXPECT_TRUE(held.take_whole(next, seconds(102))) << "of the same time";
  EXPECT_TRUE(same(held.map(), next));
}

TEST(HeldMap, TakesAnOlderMapWhenABagLoopsOrTheGridIsNewOrNoPartsCame) {
  HeldMap held;
  held.take_whole(rough(), seconds(100));
  held.take_part(submap(rough(), {0, 32, 0, 32}), seconds(102));
  EXPECT_TRUE(held.take_whole(rough(), seconds(91)));
  EXPECT_EQ(held.stamp(), seconds(91));
  EXPECT_TRUE(held.take_whole(rough(), seconds(90))) << "forecasts of several horizons go back and forth";

  held.take_part(submap(rough(), {0, 32, 0, 32}), seconds(95));
  EXPECT_TRUE(held.take_whole(rough(GridGeometry(0, 0, 0.01, 30, 30)), seconds(94)));
}

TEST(HeldMap, TakesALatePartButKeepsTheNewestStamp) {
  HeldMap held;
  held.take_whole(rough(), seconds(100));
  EXPECT_TRUE(held.take_part(submap(rough(grid, 2), {0, 32, 0, 32}), milliseconds(99900)));
  EXPECT_EQ(held.stamp(), seconds(100));
  held.take_part(submap(rough(grid, 2), {0, 32, 0, 32}), seconds(10));
  EXPECT_EQ(held.stamp(), seconds(10)) << "a bag that loops";
}

TEST(HeldMap, WaitsForAWholeMap) {
  HeldMap held;
  EXPECT_FALSE(held.take_part(submap(rough(), {0, 32, 0, 32}), seconds(1)));
  EXPECT_FALSE(held.known());
  // All cells as a part, and a part of those, before the whole map that is older.
  const HeightMap next = rough(grid, 2);
  EXPECT_FALSE(held.take_part(next, seconds(3)));
  EXPECT_FALSE(held.take_part(submap(rough(grid, 3), {0, 32, 0, 32}), seconds(4)));
  EXPECT_EQ(held.take_whole(rough(), seconds(2))->count(), 12);
  HeightMap expected = next;
  paste(submap(rough(grid, 3), {0, 32, 0, 32}), {0, 32, 0, 32}, expected);
  EXPECT_TRUE(same(held.map(), expected));
  EXPECT_EQ(held.stamp(), seconds(4));
  EXPECT_FALSE(held.take_whole(rough(), seconds(3)));
}

TEST(HeldMap, ForgetsAPartThatTheWholeMapFollowed) {
  HeldMap held;
  held.take_part(submap(rough(grid, 2), {0, 32, 0, 32}), seconds(1));
  held.take_whole(rough(), seconds(2));
  EXPECT_TRUE(same(held.map(), rough()));
  EXPECT_EQ(held.stamp(), seconds(2));
}

TEST(HeldMap, LeavesAMapAloneThatAPartDoesNotFit) {
  HeldMap held;
  held.take_whole(rough(), seconds(1));
  const GridGeometry between(grid.origin_x() + 0.005, grid.origin_y(), grid.cell(), 32, 32);
  const GridGeometry beyond(grid.origin_x() - 0.32, grid.origin_y(), grid.cell(), 64, 32);
  EXPECT_FALSE(held.take_part(rough(between), seconds(2)));
  EXPECT_FALSE(held.take_part(rough(beyond), seconds(2)));
  EXPECT_TRUE(same(held.map(), rough()));
  EXPECT_EQ(held.stamp(), seconds(1));
}

}  // namespace
}  // namespace aeolian
