#include "aeolian_core/surface/resample.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr float nan = HeightMap::unknown;

float plane(double x, double y) { return static_cast<float>(0.3 * x - 0.7 * y + 0.1); }

/// The plane on a grid whose lower left corner counts as (0, 0).
HeightMap plane_map(const GridGeometry& grid) {
  HeightMap map(grid);
  auto& values = map.add(layer::elevation);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const CellIndex cell = grid.cell_at(i);
    values[i] = plane((cell.x + 0.5) * grid.cell(), (cell.y + 0.5) * grid.cell());
  }
  return map;
}

HeightMap random_map(const GridGeometry& grid) {
  HeightMap map(grid);
  RandomStream random(1, 0);
  for (float& value : map.add(layer::elevation)) value = static_cast<float>(1 + random.uniform());
  return map;
}

double volume(const HeightMap& map) {
  double sum = 0;
  for (const float value : map.layer(layer::elevation)) sum += static_cast<double>(value);
  return sum * map.geometry().cell() * map.geometry().cell();
}

TEST(Resample, ReproducesAPlaneOnFinerShiftedCells) {
  const double east = 512345.25;
  const double north = 5401234.5;
  const HeightMap map = plane_map(GridGeometry(east, north, 0.5, 20, 12));
  const GridGeometry target(east + 1.1, north + 0.9, 0.17, 30, 20);
  const HeightMap fine = resample(map, target);
  for (int y = 0; y < target.ny(); ++y)
    for (int x = 0; x < target.nx(); ++x)
      EXPECT_NEAR(fine.layer(layer::elevation)[target.index(x, y)],
                  plane(target.x(x) - east, target.y(y) - north), 1e-5);
}

TEST(Resample, ReproducesAPlaneOnCoarserCells) {
  const HeightMap map = plane_map(GridGeometry(0, 0, 0.1, 30, 18));
  const GridGeometry target(0, 0, 0.3, 10, 6);
  const HeightMap coarse = resample(map, target);
  for (int y = 0; y < target.ny(); ++y)
    for (int x = 0; x < target.nx(); ++x)
      EXPECT_NEAR(coarse.layer(layer::elevation)[target.index(x, y)], plane(target.x(x), target.y(y)), 1e-6);
}

TEST(Resample, ConservesVolumeUnderRefinementByAnInteger) {
  const HeightMap map = random_map(GridGeometry(-3, 7, 0.25, 16, 12));
  for (const int factor : {1, 2, 3, 4, 7}) {
    const GridGeometry target(-3, 7, 0.25 / factor, 16 * factor, 12 * factor);
    EXPECT_NEAR(volume(resample(map, target)) / volume(map), 1, 1e-7) << "factor " << factor;
  }
}

TEST(Resample, ConservesVolumeUnderCoarseningByAnyFactor) {
  const HeightMap map = random_map(GridGeometry(0, 0, 0.2, 30, 20));
  for (const int nx : {15, 12, 6, 3}) {  // factors 2, 2.5, 5, 10
    const GridGeometry target(0, 0, 6.0 / nx, nx, nx * 2 / 3);
    EXPECT_NEAR(volume(resample(map, target)) / volume(map), 1, 1e-7) << nx << " cells";
  }
}

TEST(Resample, OntoItsOwnGridChangesNothing) {
  const HeightMap map = random_map(GridGeometry(512345.678, 5401234.567, 0.002, 20, 30));
  EXPECT_EQ(resample(map, map.geometry()).layer(layer::elevation), map.layer(layer::elevation));
}

TEST(Resample, CutsOutAnAlignedPartExactlyAtUtmCoordinates) {
  // Neither origin is a number of cells in binary, so weights come out a little beside 0 and 1.
  HeightMap map = random_map(GridGeometry::covering(512345.6, 5401234.5, 512345.7, 5401234.6, 0.002));
  const GridGeometry& grid = map.geometry();
  map.layer(layer::elevation)[grid.index(4, 4)] = nan;
  const GridGeometry part = GridGeometry::covering(512345.61, 5401234.51, 512345.65, 5401234.54, 0.002);
  const HeightMap cut = resample(map, part);
  for (int y = 0; y < part.ny(); ++y)
    for (int x = 0; x < part.nx(); ++x)
      EXPECT_EQ(cut.layer(layer::elevation)[part.index(x, y)],
                map.layer(layer::elevation)[grid.index(x + 5, y + 5)]);
}

TEST(Resample, FinerCellsBesideUnknownOnesAndOutsideAreUnknown) {
  HeightMap map(GridGeometry(0, 0, 1, 3, 1));
  map.add(layer::elevation, HeightMap::Layer{1, 2, nan});
  const auto fine = resample(map, GridGeometry(-0.5, 0, 0.5, 8, 1)).layer(layer::elevation);
  EXPECT_TRUE(std::isnan(fine[0])) << "outside";
  EXPECT_EQ(fine[1], 1) << "within half a cell of the border: its cell";
  EXPECT_EQ(fine[2], 1.25F);
  EXPECT_EQ(fine[3], 1.75F);
  EXPECT_TRUE(std::isnan(fine[4])) << "the unknown cell has weight";
  EXPECT_TRUE(std::isnan(fine[7]));
}

TEST(Resample, CoarserCellsNeedHalfOfTheirAreaKnown) {
  HeightMap map(GridGeometry(0, 0, 1, 6, 2));
  map.add(layer::elevation, HeightMap::Layer{1, 3, nan, 5, nan, nan,  //
                                             nan, nan, nan, 7, 9, nan});
  const auto coarse = resample(map, GridGeometry(0, 0, 2, 4, 1)).layer(layer::elevation);
  EXPECT_EQ(coarse[0], 2) << "half is enough";
  EXPECT_EQ(coarse[1], 6);
  EXPECT_TRUE(std::isnan(coarse[2])) << "a quarter is not";
  EXPECT_TRUE(std::isnan(coarse[3])) << "outside";
}

TEST(Resample, CarriesAllLayers) {
  HeightMap map(GridGeometry(0, 0, 1, 2, 2));
  map.add(layer::elevation, 1);
  map.add(layer::age, 60);
  EXPECT_EQ(resample(map, GridGeometry(0, 0, 2, 1, 1)).layer(layer::age), HeightMap::Layer{60});
}

TEST(Sample, IsBilinearBetweenCentresAndConstantTowardsTheBorder) {
  const GridGeometry grid(10, 20, 2, 2, 2);
  const HeightMap::Layer values{0, 1, 2, 3};
  EXPECT_DOUBLE_EQ(sample(grid, values, 12, 22), 1.5);
  EXPECT_DOUBLE_EQ(sample(grid, values, 11.5, 21), 0.25);
  EXPECT_DOUBLE_EQ(sample(grid, values, 10.2, 20.1), 0);
  EXPECT_DOUBLE_EQ(sample(grid, values, 14, 24), 3);
}

TEST(Sample, IsUnknownOutsideAndBesideUnknownCells) {
  const GridGeometry grid(0, 0, 1, 2, 1);
  EXPECT_TRUE(std::isnan(sample(grid, {1, 2}, -0.01, 0.5)));
  EXPECT_TRUE(std::isnan(sample(grid, {1, 2}, 0.5, 1.01)));
  EXPECT_TRUE(std::isnan(sample(grid, {1, 2}, NAN, 0.5)));
  EXPECT_TRUE(std::isnan(sample(grid, {1, nan}, 0.6, 0.5)));
  EXPECT_EQ(sample(grid, {1, nan}, 0.5, 0.5), 1) << "an unknown cell without weight does not matter";
}

}  // namespace
}  // namespace aeolian
