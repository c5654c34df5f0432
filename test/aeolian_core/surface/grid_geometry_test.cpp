#include "aeolian_core/surface/grid_geometry.hpp"

#include <limits>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(GridGeometry, IndexAndCellAreInverse) {
  const GridGeometry grid(-1, 2, 0.1, 7, 5);
  for (std::size_t i = 0; i < grid.size(); ++i) EXPECT_EQ(grid.index(grid.cell_at(i)), i);
  EXPECT_EQ(grid.index(1, 0), 1U) << "x runs fastest";
}

TEST(GridGeometry, FindsEveryCellByItsCentreAlsoAtUtmCoordinates) {
  const GridGeometry grid(512345.678, 5401234.567, 0.002, 50, 40);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const CellIndex cell = grid.cell_at(i);
    const auto found = grid.find(grid.x(cell.x), grid.y(cell.y));
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, cell);
  }
}

TEST(GridGeometry, LowerEdgesBelongToACellUpperEdgesDoNot) {
  const GridGeometry grid(0, 0, 0.5, 4, 2);
  EXPECT_EQ(grid.find(0, 0), (CellIndex{0, 0}));
  EXPECT_EQ(grid.find(0.5, 0.5), (CellIndex{1, 1}));
  EXPECT_FALSE(grid.find(2, 0.1));
  EXPECT_FALSE(grid.find(0.1, 1));
  EXPECT_FALSE(grid.find(-1e-12, 0.1));
}

TEST(GridGeometry, FindsNothingForCoordinatesThatAreNotFinite) {
  const GridGeometry grid(0, 0, 1, 2, 2);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(grid.find(nan, 1));
  EXPECT_FALSE(grid.find(1, nan));
  EXPECT_FALSE(grid.find(infinity, 1));
  EXPECT_FALSE(grid.find(1, -infinity));
}

TEST(GridGeometry, CoversBoundsWithCellsOnMultiplesOfTheCellSize) {
  EXPECT_EQ(GridGeometry::covering(0.25, -0.25, 0.75, 0.5, 0.5), GridGeometry(0, -0.5, 0.5, 2, 2));
  EXPECT_EQ(GridGeometry::covering(-1, -1, 1, 1, 1), GridGeometry(-1, -1, 1, 2, 2));
}

TEST(GridGeometry, CoveringIgnoresRoundingAtAnEdge) {
  // 0.3 / 0.1 is 2.9999999999999996, (0.1 + 0.2) / 0.1 is 3.0000000000000004: both are three cells.
  EXPECT_EQ(GridGeometry::covering(0, 0, 0.3, 0.1 + 0.2, 0.1).nx(), 3);
  EXPECT_EQ(GridGeometry::covering(0, 0, 0.3, 0.1 + 0.2, 0.1).ny(), 3);
  EXPECT_EQ(GridGeometry::covering(0.3, 0.1 + 0.2, 1, 1, 0.1).nx(), 7);
  EXPECT_EQ(GridGeometry::covering(0.3, 0.1 + 0.2, 1, 1, 0.1).ny(), 7);
}

TEST(GridGeometry, CoversASinglePoint) {
  const GridGeometry grid = GridGeometry::covering(512345.5, 5401234.25, 512345.5, 5401234.25, 0.1);
  EXPECT_EQ(grid.size(), 1U);
  EXPECT_TRUE(grid.find(512345.55, 5401234.25));
}

TEST(GridGeometry, CoversAllPointsAtUtmCoordinates) {
  const double x0 = 512345.6789;
  const double y0 = 5401234.5678;
  const GridGeometry grid = GridGeometry::covering(x0, y0, x0 + 1.2345, y0 + 0.789, 0.002);
  EXPECT_TRUE(grid.find(x0, y0));
  EXPECT_TRUE(grid.find(x0 + 1.2345, y0 + 0.789));
  EXPECT_NEAR(grid.length_x(), 1.2345, 0.005);
  EXPECT_NEAR(grid.length_y(), 0.789, 0.005);
}

TEST(GridGeometry, RefusesWhatIsNoGrid) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(error_of([] { GridGeometry(0, 0, 0, 1, 1); }).find("must be positive"), std::string::npos);
  EXPECT_THROW(GridGeometry(0, 0, -1, 1, 1), Error);
  EXPECT_THROW(GridGeometry(0, 0, nan, 1, 1), Error);
  EXPECT_THROW(GridGeometry(nan, 0, 1, 1, 1), Error);
  EXPECT_THROW(GridGeometry(0, 0, 1, 0, 1), Error);
  EXPECT_THROW(GridGeometry(0, 0, 1, 1 << 16, 1 << 15), Error);
  EXPECT_THROW(GridGeometry::covering(1, 0, 0, 1, 1), Error);
  EXPECT_THROW(GridGeometry::covering(nan, 0, 1, 1, 1), Error);
  EXPECT_NE(error_of([] { GridGeometry::covering(0, 0, 1e6, 1e6, 1e-3); }).find("too small"),
            std::string::npos);
}

}  // namespace
}  // namespace aeolian
