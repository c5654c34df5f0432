#include "aeolian_core/surface/thinning.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/resample.hpp"

namespace aeolian {
namespace {

const GridGeometry grid(3, -2, 0.25, 100, 70);

HeightMap rough() {
  HeightMap map(grid);
  RandomStream random(3, 0);
  for (float& z : map.add(layer::elevation))
    z = random.uniform() < 0.4 ? HeightMap::unknown : static_cast<float>(random.normal());
  return map;
}

TEST(Thinning, CellsOfALengthAreNeverLessThanOne) {
  EXPECT_EQ(cells_within(grid, 1), 4);
  EXPECT_EQ(cells_within(grid, 0.99), 3);
  EXPECT_EQ(cells_within(grid, 0.01), 1);
  EXPECT_EQ(cells_within(GridGeometry(0, 0, 0.1, 5, 5), 0.3), 3);  // though 0.3 / 0.1 < 3
}

TEST(Thinning, IsTheResampledMap) {
  const HeightMap map = rough();
  for (const int factor : {2, 3, 8, 33}) {
    const GridGeometry coarse = thinned(grid, factor);
    HeightMap::Layer result(coarse.size(), -99);
    thin(grid, map.layer(layer::elevation), factor, {0, coarse.nx(), 0, coarse.ny()}, result);
    const HeightMap expected = resample(map, coarse);
    for (std::size_t i = 0; i < result.size(); ++i) {
      const float z = expected.layer(layer::elevation)[i];
      EXPECT_EQ(std::isnan(result[i]), std::isnan(z)) << factor;
      if (!std::isnan(z)) {
        EXPECT_NEAR(result[i], z, 1e-6) << factor;
      }
    }
  }
}

TEST(Thinning, OfARangeWritesNothingElse) {
  const HeightMap map = rough();
  const GridGeometry coarse = thinned(grid, 8);
  HeightMap::Layer all(coarse.size());
  thin(grid, map.layer(layer::elevation), 8, {0, coarse.nx(), 0, coarse.ny()}, all);
  HeightMap::Layer some(coarse.size(), -99);
  thin(grid, map.layer(layer::elevation), 8, {2, 5, 1, 4}, some);
  for (std::size_t i = 0; i < some.size(); ++i) {
    const CellIndex block = coarse.cell_at(i);
    const bool inside = block.x >= 2 && block.x < 5 && block.y >= 1 && block.y < 4;
    if (!inside)
      EXPECT_EQ(some[i], -99);
    else
      EXPECT_TRUE(some[i] == all[i] || (std::isnan(some[i]) && std::isnan(all[i])));
  }
}

TEST(Thinning, OfTilesCoversTheBlocksOfTheirCells) {
  const GridGeometry large(0, 0, 1, 600, 500);
  for (const int factor : {1, 2, 3, 5, 16}) {
    RandomStream random(9, static_cast<std::uint64_t>(factor));
    TileMask tiles(large);
    for (int i = 0; i < 6; ++i)
      tiles.activate(static_cast<int>(600 * random.uniform()), static_cast<int>(500 * random.uniform()));
    const TileMask coarse = thinned(tiles, large, factor);
    TileMask expected(thinned(large, factor));
    tiles.for_each([&](const CellRange& r) {
      for (int y = r.y0; y < r.y1; ++y)
        for (int x = r.x0; x < r.x1; ++x) expected.activate(x / factor, y / factor);
    });
    EXPECT_EQ(rectangles(coarse), rectangles(expected)) << factor;
  }
}

}  // namespace
}  // namespace aeolian
