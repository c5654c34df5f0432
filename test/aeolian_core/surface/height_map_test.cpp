#include "aeolian_core/surface/height_map.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr float nan = HeightMap::unknown;

TEST(HeightMap, KeepsLayersByNameInOrder) {
  HeightMap map(GridGeometry(0, 0, 1, 3, 2));
  EXPECT_FALSE(map.has(layer::elevation));
  map.add("b");
  map.add(layer::elevation, 2);
  EXPECT_EQ(map.names(), (std::vector<std::string>{"b", "elevation"}));
  EXPECT_TRUE(std::isnan(map.layer("b")[5]));
  EXPECT_EQ(map.layer(layer::elevation), HeightMap::Layer(6, 2));
  map.add("b", 1);
  EXPECT_EQ(map.layer("b"), HeightMap::Layer(6, 1)) << "adding again resets";
  map.remove("b");
  map.remove("b");
  EXPECT_EQ(map.names(), std::vector<std::string>{"elevation"});
}

TEST(HeightMap, AReferenceToALayerOutlivesTheAddingOfOthers) {
  HeightMap map(GridGeometry(0, 0, 1, 2, 1));
  auto& first = map.add("first", 1);
  for (int i = 0; i < 20; ++i) map.add("layer " + std::to_string(i), 0);
  EXPECT_EQ(&first, &map.layer("first"));
  EXPECT_EQ(first, HeightMap::Layer(2, 1));
}

TEST(HeightMap, NamesAnAbsentLayer) {
  const HeightMap map(GridGeometry(0, 0, 1, 1, 1));
  EXPECT_NE(error_of([&] { map.layer("variance"); }).find("'variance'"), std::string::npos);
}

TEST(HeightMap, RefusesALayerOfAnotherSize) {
  HeightMap map(GridGeometry(0, 0, 1, 3, 2));
  const std::string message = error_of([&] { map.add("elevation", HeightMap::Layer(5, 0)); });
  EXPECT_NE(message.find("5 values for 6 cells"), std::string::npos) << message;
  EXPECT_FALSE(map.has("elevation"));
}

TEST(CountKnown, CountsFiniteCells) { EXPECT_EQ(count_known({1, nan, 0, INFINITY, nan}), 2U); }

TEST(Filled, InterpolatesLinearlyAlongASingleRow) {
  const GridGeometry row(0, 0, 1, 7, 1);
  EXPECT_EQ(filled(row, {0, nan, nan, nan, nan, 5, 6}), (HeightMap::Layer{0, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(filled(row, {nan, nan, 3, 4, nan, nan, nan}), (HeightMap::Layer{3, 3, 3, 4, 4, 4, 4}));
}

TEST(Filled, ReproducesAPlaneInASymmetricHole) {
  const GridGeometry grid(0, 0, 1, 9, 9);
  HeightMap::Layer plane(grid.size());
  for (std::size_t i = 0; i < plane.size(); ++i)
    plane[i] = 0.5F * static_cast<float>(grid.cell_at(i).x) - 0.25F * static_cast<float>(grid.cell_at(i).y);
  HeightMap::Layer holed = plane;
  for (int y = 3; y < 6; ++y)
    for (int x = 3; x < 6; ++x) holed[grid.index(x, y)] = nan;
  const HeightMap::Layer result = filled(grid, holed);
  for (std::size_t i = 0; i < plane.size(); ++i) EXPECT_NEAR(result[i], plane[i], 1e-6);
}

TEST(Filled, LeavesKnownCellsAloneAndNothingUnknown) {
  const GridGeometry grid(0, 0, 1, 4, 4);
  HeightMap::Layer values(grid.size(), nan);
  values[grid.index(1, 1)] = 3;
  values[grid.index(3, 0)] = 1;
  const HeightMap::Layer result = filled(grid, values);
  EXPECT_EQ(count_known(result), result.size());
  EXPECT_EQ(result[grid.index(1, 1)], 3);
  EXPECT_EQ(result[grid.index(3, 0)], 1);
  EXPECT_EQ(result[grid.index(0, 3)], 2) << "no known cell in its row or column: the mean of all";
}

TEST(Filled, MakesAMapWithoutKnownCellsZero) {
  EXPECT_EQ(filled(GridGeometry(0, 0, 1, 2, 2), HeightMap::Layer(4, nan)), HeightMap::Layer(4, 0));
}

}  // namespace
}  // namespace aeolian
