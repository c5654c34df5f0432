#include "aeolian_core/surface/tile_mask.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const GridGeometry grid(0, 0, 1, 70, 33);  // 3 x 2 tiles, the last ones 6 and 1 cells wide

TEST(TileMask, CoversEveryCellOnceWithSmallerTilesAtTheFarEdges) {
  const TileMask mask(grid, true);
  EXPECT_EQ(mask.tiles_x(), 3);
  EXPECT_EQ(mask.tiles_y(), 2);
  std::vector<int> visits(grid.size(), 0);
  mask.for_each([&](CellRange r) {
    for (int y = r.y0; y < r.y1; ++y)
      for (int x = r.x0; x < r.x1; ++x) ++visits[grid.index(x, y)];
  });
  EXPECT_EQ(visits, std::vector<int>(grid.size(), 1));
  const CellRange corner = mask.range(2, 1);
  EXPECT_EQ(corner.x1 - corner.x0, 6);
  EXPECT_EQ(corner.y1 - corner.y0, 1);
}

TEST(TileMask, ActivatesTheTileOfACell) {
  TileMask mask(grid);
  EXPECT_TRUE(mask.empty());
  mask.activate(31, 31);
  EXPECT_TRUE(mask.tile(0, 0));
  mask.activate(69, 32);
  EXPECT_TRUE(mask.tile(2, 1));
  EXPECT_EQ(mask.count(), 2);
  mask.clear();
  EXPECT_TRUE(mask.empty());
}

TEST(TileMask, DilatesByOneTileAlsoDiagonallyAndStaysInside) {
  TileMask mask(GridGeometry(0, 0, 1, 160, 160));
  mask.set_tile(0, 0);
  mask.dilate();
  EXPECT_EQ(mask.count(), 4);
  EXPECT_TRUE(mask.tile(1, 1));
  EXPECT_FALSE(mask.tile(2, 0));
  mask.clear();
  mask.set_tile(2, 2);
  mask.dilate();
  EXPECT_EQ(mask.count(), 9);
}

TEST(TileMask, MergesMasksOfTheSameGridOnly) {
  TileMask mask(grid);
  mask.set_tile(0, 0);
  TileMask other(grid);
  other.set_tile(0, 0);
  other.set_tile(2, 1);
  mask.merge(other);
  EXPECT_EQ(mask.count(), 2);
  // The same number of tiles is not enough: tiles at the edge would hold other cells.
  EXPECT_THROW(mask.merge(TileMask(GridGeometry(0, 0, 1, 71, 33))), Error);
}

TEST(Rectangles, JoinLikeRunsOfNeighbouringRows) {
  const GridGeometry wide(0, 0, 1, 150, 70);  // 5 x 3 tiles
  EXPECT_TRUE(rectangles(TileMask(wide)).empty());
  EXPECT_EQ(rectangles(TileMask(wide, true)), (std::vector<CellRange>{{0, 150, 0, 70}}));
  TileMask two_blocks(wide);
  for (const int ty : {0, 1})
    for (const int tx : {0, 1, 4}) two_blocks.set_tile(tx, ty);
  EXPECT_EQ(rectangles(two_blocks), (std::vector<CellRange>{{0, 64, 0, 64}, {128, 150, 0, 64}}));
}

TEST(Rectangles, CoverTheCellsOfActiveTilesOnceAndNoOther) {
  const GridGeometry large(0, 0, 1, 300, 270);
  RandomStream random(5, 0);
  for (int round = 0; round < 50; ++round) {
    TileMask mask(large);
    const double share = random.uniform();
    for (int ty = 0; ty < mask.tiles_y(); ++ty)
      for (int tx = 0; tx < mask.tiles_x(); ++tx) mask.set_tile(tx, ty, random.uniform() < share);
    std::vector<int> active(large.size(), 0);
    std::vector<int> covered(large.size(), 0);
    const auto count = [&](std::vector<int>& cells) {
      return [&](const CellRange& r) {
        for (int y = r.y0; y < r.y1; ++y)
          for (int x = r.x0; x < r.x1; ++x) ++cells[large.index(x, y)];
      };
    };
    mask.for_each(count(active));
    const std::vector<CellRange> parts = rectangles(mask);
    std::for_each(parts.begin(), parts.end(), count(covered));
    EXPECT_EQ(covered, active);
    EXPECT_LE(parts.size(), static_cast<std::size_t>(mask.count()));
  }
}

TEST(TileMask, OfNoGridIsEmpty) { EXPECT_TRUE(TileMask().empty()); }

}  // namespace
}  // namespace aeolian
