#include "aeolian_core/surface/submap.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

const GridGeometry utm(512345.6, 5401234.8, 0.002, 50, 40);

HeightMap numbered() {
  HeightMap map(utm);
  for (const std::string& name : {layer::elevation, layer::variance}) {
    HeightMap::Layer& values = map.add(name);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = static_cast<float>(i) + (name == layer::variance ? 0.5F : 0);
  }
  return map;
}

TEST(Submap, HasTheValuesOfAllLayersAtTheirPlaces) {
  const HeightMap map = numbered();
  const HeightMap part = submap(map, {10, 17, 33, 40});
  EXPECT_EQ(part.geometry().nx(), 7);
  EXPECT_EQ(part.geometry().ny(), 7);
  EXPECT_EQ(part.names(), map.names());
  for (int y = 0; y < 7; ++y) {
    for (int x = 0; x < 7; ++x) {
      EXPECT_NEAR(part.geometry().x(x), utm.x(x + 10), 1e-8);
      EXPECT_NEAR(part.geometry().y(y), utm.y(y + 33), 1e-8);
      for (const std::string& name : map.names())
        EXPECT_EQ(part.layer(name)[part.geometry().index(x, y)], map.layer(name)[utm.index(x + 10, y + 33)]);
    }
  }
}

TEST(Submap, RefusesCellsBeyondTheMapAndNone) {
  const HeightMap map = numbered();
  for (const CellRange& range : {CellRange{-1, 5, 0, 5}, CellRange{0, 51, 0, 5}, CellRange{0, 5, 3, 41},
                                 CellRange{5, 5, 0, 5}, CellRange{0, 5, 9, 3}})
    EXPECT_THROW(submap(map, range), Error);
}

TEST(RangeWithin, FindsAPartOfAMapInLargeCoordinates) {
  for (const CellRange& range :
       {CellRange{0, 50, 0, 40}, CellRange{0, 1, 0, 1}, CellRange{49, 50, 39, 40}, CellRange{7, 31, 2, 40}}) {
    const auto found = range_within(part_of(utm, range), utm);
    ASSERT_TRUE(found.has_value());
    EXPECT_EQ(*found, range);
  }
}

TEST(RangeWithin, RefusesWhatLiesElsewhereOrHasOtherCells) {
  const GridGeometry whole(0, 0, 0.1, 50, 40);
  EXPECT_TRUE(range_within(GridGeometry(0.5, 0.5, 0.1, 10, 10), whole));
  EXPECT_TRUE(range_within(GridGeometry(0.5005, 0.5, 0.1, 10, 10), whole)) << "half a percent of a cell";
  EXPECT_FALSE(range_within(GridGeometry(0.505, 0.5, 0.1, 10, 10), whole)) << "between the cells";
  EXPECT_FALSE(range_within(GridGeometry(0.5, 0.5, 0.2, 10, 10), whole)) << "larger cells";
  EXPECT_FALSE(range_within(GridGeometry(0.5, 0.5, 0.1002, 10, 10), whole)) << "slightly larger cells";
  EXPECT_FALSE(range_within(GridGeometry(-0.1, 0.5, 0.1, 10, 10), whole)) << "west of it";
  EXPECT_FALSE(range_within(GridGeometry(4.1, 0.5, 0.1, 10, 10), whole)) << "reaches out in the east";
  EXPECT_FALSE(range_within(GridGeometry(0.5, 3.1, 0.1, 10, 10), whole)) << "reaches out in the north";
  EXPECT_FALSE(range_within(GridGeometry(1e30, 0, 0.1, 10, 10), whole));
  EXPECT_FALSE(range_within(whole, GridGeometry(0.5, 0.5, 0.1, 10, 10))) << "larger than the whole";
}

TEST(Paste, OfASubmapGivesTheMapBackAndTouchesNothingElse) {
  const HeightMap map = numbered();
  HeightMap other = numbered();
  for (const std::string& name : other.names())
    for (float& v : other.layer(name)) v = -v - 1;
  const CellRange range{3, 35, 8, 20};
  HeightMap pasted = other;
  paste(submap(map, range), range, pasted);
  for (const std::string& name : map.names()) {
    for (std::size_t i = 0; i < utm.size(); ++i) {
      const CellIndex c = utm.cell_at(i);
      const bool inside = c.x >= 3 && c.x < 35 && c.y >= 8 && c.y < 20;
      EXPECT_EQ(pasted.layer(name)[i], (inside ? map : other).layer(name)[i]);
    }
  }
}

TEST(Paste, LeavesLayersAloneThatOneOfThemLacks) {
  HeightMap whole = numbered();
  HeightMap part(part_of(utm, {0, 2, 0, 2}));
  part.add(layer::elevation, -1);
  part.add("rate", 1);
  paste(part, {0, 2, 0, 2}, whole);
  EXPECT_EQ(whole.names(), numbered().names());
  EXPECT_EQ(whole.layer(layer::elevation)[0], -1);
  EXPECT_EQ(whole.layer(layer::variance), numbered().layer(layer::variance));
}

TEST(Paste, RefusesAPlaceThatDoesNotFit) {
  HeightMap whole = numbered();
  const HeightMap part = submap(whole, {0, 2, 0, 2});
  EXPECT_THROW(paste(part, {0, 3, 0, 2}, whole), Error);
  EXPECT_THROW(paste(part, {49, 51, 0, 2}, whole), Error);
}

}  // namespace
}  // namespace aeolian
