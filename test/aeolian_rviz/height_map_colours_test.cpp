#include "aeolian_rviz/height_map_colours.hpp"

#include <cmath>

#include "../sloping_plane.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr float nan = HeightMap::unknown;

std::vector<Rgba> all_colours(const GridGeometry& grid, const HeightMap::Layer& heights,
                              const HeightMap::Layer& values, const Colouring& colouring) {
  std::vector<Rgba> colours(grid.size());
  HeightMapColours(colouring).colour(grid, heights, values, {0, grid.nx(), 0, grid.ny()}, colours.data(),
                                     grid.nx());
  return colours;
}

double brightness(const Rgba& c) { return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]; }

Colouring plain(Palette palette, ValueRange range) {
  Colouring colouring;
  colouring.palette = palette;
  colouring.range = range;
  colouring.shaded = false;
  return colouring;
}

TEST(HeightMapColours, OfAPlaneAreThoseOfPictures) {
  const GridGeometry grid(500000, 4e6, 0.5, 40, 30);
  HeightMap::Layer heights = sloping_plane(GridGeometry(0, 0, 0.5, 40, 30), 0.2, -0.4);
  Colouring colouring;
  colouring.range = {-2, 3};
  colouring.exaggeration = 2;
  const std::vector<Rgb> expected =
      shaded_colours(grid, heights, colouring.palette, colouring.range, &heights, colouring.exaggeration);
  const std::vector<Rgba> colours = all_colours(grid, heights, heights, colouring);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(colours[i][c], expected[i][c], 2) << i;
    EXPECT_EQ(colours[i][3], 255);
  }
}

TEST(HeightMapColours, DivergingShowsTheSignOfTheColourLayer) {
  const GridGeometry grid(0, 0, 1, 3, 1);
  const std::vector<Rgba> colours =
      all_colours(grid, {5, 5, 5}, {-1, 0, 1}, plain(Palette::diverging, {-1, 1}));
  EXPECT_GT(colours[0][2], colours[0][0] + 50);
  EXPECT_GT(colours[1][0], 240);
  EXPECT_GT(colours[1][2], 240);
  EXPECT_GT(colours[2][0], colours[2][2] + 50);
}

TEST(HeightMapColours, CellsWithoutAHeightAreTransparentInTheColourBesideThem) {
  const GridGeometry grid(0, 0, 1, 3, 1);
  const std::vector<Rgba> colours =
      all_colours(grid, {0, nan, nan}, {0.2F, 1, 1}, plain(Palette::sand, {0, 1}));
  EXPECT_EQ(colours[0][3], 255);
  EXPECT_EQ(colours[1][3], 0);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(colours[1][c], colours[0][c]);
  EXPECT_EQ(colours[2][3], 0);
}

TEST(HeightMapColours, CellsWithoutAValueAreGreyAndSeen) {
  const GridGeometry grid(0, 0, 1, 2, 1);
  for (const float unknown : {nan, INFINITY}) {
    const Rgba c = all_colours(grid, {0, 0}, {0, unknown}, plain(Palette::diverging, {-1, 1}))[1];
    EXPECT_TRUE(c[0] == c[1] && c[1] == c[2] && c[3] == 255);
  }
}

TEST(HeightMapColours, ShadingBesideAHoleUsesTheSideThatIsKnown) {
  const GridGeometry grid(0, 0, 1, 5, 5);
  HeightMap::Layer heights = sloping_plane(grid, 0.3, 0);
  Colouring colouring;
  colouring.range = {-100, 100};
  const Rgba whole = all_colours(grid, heights, heights, colouring)[grid.index(2, 2)];
  heights[grid.index(3, 2)] = nan;
  EXPECT_EQ(all_colours(grid, heights, heights, colouring)[grid.index(2, 2)], whole);
}

TEST(HeightMapColours, OfAPartAreThoseOfTheWhole) {
  const GridGeometry grid(0, 0, 1, 50, 40);
  HeightMap::Layer heights(grid.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
    heights[i] = i % 17 == 3 ? nan : static_cast<float>(std::sin(0.3 * static_cast<double>(i)));
  Colouring colouring;
  colouring.range = {-1, 1};
  colouring.contour_interval = 0.2;
  const std::vector<Rgba> whole = all_colours(grid, heights, heights, colouring);
  const CellRange part{7, 31, 0, 40};
  std::vector<Rgba> colours(grid.size());
  HeightMapColours(colouring).colour(grid, heights, heights, part, &colours[grid.index(7, 0)], grid.nx());
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) EXPECT_EQ(colours[grid.index(x, y)], whole[grid.index(x, y)]);
}

TEST(HeightMapColours, NoRangeGivesTheMiddleColour) {
  const GridGeometry grid(0, 0, 1, 2, 1);
  for (const ValueRange range : {ValueRange{0, 0}, ValueRange{3, -3}, ValueRange{0, 1e-300}}) {
    const Rgba c = all_colours(grid, {0, 0}, {0, 7}, plain(Palette::diverging, range))[0];
    EXPECT_GT(c[0], 240);
    EXPECT_GT(c[2], 240);
  }
}

TEST(Contours, PassWhereTheHeightIsAMultipleOfTheInterval) {
  const GridGeometry grid(0, 0, 1, 100, 3);
  // Ten cells a line, the first through the centre of cell 10.
  HeightMap::Layer heights = sloping_plane(grid, 0.1, 0);
  for (float& z : heights) z -= 0.05F;
  Colouring colouring = plain(Palette::grey, {0, 1});
  colouring.contour_interval = 1;
  const std::vector<Rgba> colours = all_colours(grid, heights, heights, colouring);
  const auto dark = [&](int x) { return brightness(colours[grid.index(x, 1)]) < 150; };
  for (int x = 1; x < 99; ++x) EXPECT_EQ(dark(x), x % 10 == 0) << x;
  EXPECT_LT(brightness(colours[grid.index(50, 1)]), brightness(colours[grid.index(40, 1)]) - 20)
      << "every fifth line is stronger";
}

TEST(Contours, AreNotDrawnOnLevelGroundNorWhereTheyWouldFillTheArea) {
  const GridGeometry grid(0, 0, 1, 20, 20);
  Colouring colouring = plain(Palette::grey, {0, 1});
  for (const double slope : {0.0, 1.0}) {
    const HeightMap::Layer heights = sloping_plane(grid, slope, 0);
    colouring.contour_interval = 0;
    const std::vector<Rgba> without = all_colours(grid, heights, heights, colouring);
    colouring.contour_interval = 1;
    EXPECT_EQ(all_colours(grid, heights, heights, colouring), without) << slope;
  }
}

TEST(RoundContourInterval, IsRoundAndGivesSomeTenLines) {
  for (double width = 0.0123; width < 300; width *= 1.37) {
    const double interval = round_contour_interval({-0.3 * width, 0.7 * width});
    EXPECT_GE(width / interval, 6.5);
    EXPECT_LE(width / interval, 17.5);
    const double digits = interval / std::pow(10, std::floor(std::log10(interval * 1.000001)));
    EXPECT_TRUE(std::abs(digits - 1) < 1e-6 || std::abs(digits - 2) < 1e-6 || std::abs(digits - 5) < 1e-6);
  }
  EXPECT_EQ(round_contour_interval({2, 2}), 0);
}

TEST(Halve, AveragesWhatIsSeen) {
  const std::vector<Rgba> fine{{10, 0, 0, 255}, {30, 0, 0, 255}, {99, 99, 99, 0}, {99, 99, 99, 0},
                               {20, 0, 0, 255}, {40, 0, 0, 255}, {99, 99, 99, 0}, {60, 0, 0, 255},
                               {0, 0, 0, 0},    {0, 0, 0, 0},    {7, 7, 7, 255},  {7, 7, 7, 255},
                               {0, 0, 0, 0},    {0, 0, 0, 0},    {7, 7, 7, 255},  {7, 7, 7, 255}};
  std::vector<Rgba> coarse(4, Rgba{1, 2, 3, 4});
  halve(fine.data(), 4, {0, 4, 0, 3}, coarse.data());
  EXPECT_EQ(coarse[0], (Rgba{25, 0, 0, 255}));
  EXPECT_EQ(coarse[1], (Rgba{60, 0, 0, 255}));
  EXPECT_EQ(coarse[2][3], 0);
  EXPECT_EQ(coarse[3], (Rgba{7, 7, 7, 255}));
}

TEST(Halve, WritesOnlyWhatDependsOnTheRange) {
  const std::vector<Rgba> fine(64, Rgba{8, 8, 8, 255});
  std::vector<Rgba> coarse(16, Rgba{});
  halve(fine.data(), 8, {3, 5, 2, 3}, coarse.data());
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(coarse[static_cast<std::size_t>(4 * y + x)][3], y == 1 && (x == 1 || x == 2) ? 255 : 0);
}

TEST(QuickDisplayRange, IsNearTheWholeLayers) {
  HeightMap::Layer values(1000 * 1000);
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = i % 3 == 0 ? nan : static_cast<float>(std::sin(2e-3 * static_cast<double>(i)));
  const ValueRange whole = display_range(values, Palette::sand);
  const ValueRange quick = quick_display_range(values, Palette::sand);
  EXPECT_NEAR(quick.low, whole.low, 0.01);
  EXPECT_NEAR(quick.high, whole.high, 0.01);
}

TEST(QuickDisplayRange, FindsTheFewThatAreKnown) {
  HeightMap::Layer values(1000 * 1000, nan);
  values[123457] = 3;
  EXPECT_EQ(quick_display_range(values, Palette::sand).low, 3);
}

TEST(SteadyRange, FollowsLargeChangesOnly) {
  EXPECT_EQ(steady_range({0, 1}, {0.05, 0.95}).low, 0);
  EXPECT_EQ(steady_range({0, 1}, {0.3, 1}).low, 0.3);
  EXPECT_EQ(steady_range({0, 1}, {0, 5}).high, 5);
}

}  // namespace
}  // namespace aeolian
