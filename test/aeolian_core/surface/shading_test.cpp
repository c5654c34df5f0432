#include "aeolian_core/surface/shading.hpp"

#include <cmath>

#include "../../sloping_plane.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr float nan = HeightMap::unknown;
const float flat = static_cast<float>(std::sqrt(0.5));

TEST(HillShade, OfAPlaneIsTheCosineToTheLamp) {
  const GridGeometry grid(0, 0, 0.5, 6, 4);
  for (const double a : {-0.8, 0.0, 0.3})
    for (const double b : {-0.5, 0.0, 0.9}) {
      // Unit normal times the direction to a lamp in the north-west, 45 degrees high.
      const double cosine = (0.5 * a - 0.5 * b + std::sqrt(0.5)) / std::sqrt(1 + a * a + b * b);
      for (const float shade : hill_shade(grid, sloping_plane(grid, a, b)))
        EXPECT_NEAR(shade, std::max(0.0, cosine), 1e-5) << a << " " << b;
    }
}

TEST(HillShade, IsOneTowardsTheLampAndZeroInItsShadow) {
  const GridGeometry grid(0, 0, 1, 3, 3);
  const double s = std::sqrt(0.5);
  EXPECT_NEAR(hill_shade(grid, sloping_plane(grid, s, -s))[4], 1, 1e-6);
  EXPECT_EQ(hill_shade(grid, sloping_plane(grid, -5, 5))[4], 0);
}

TEST(HillShade, ExaggeratesHeights) {
  const GridGeometry grid(0, 0, 1, 3, 3);
  EXPECT_EQ(hill_shade(grid, sloping_plane(grid, 0.125, 0.25), 4),
            hill_shade(grid, sloping_plane(grid, 0.5, 1)));
}

TEST(HillShade, UnknownCellsAndThoseBesideThemCountAsFlat) {
  const GridGeometry grid(0, 0, 1, 5, 5);
  HeightMap::Layer values = sloping_plane(grid, 0.5, 0);
  values[grid.index(2, 2)] = nan;
  const auto shade = hill_shade(grid, values);
  for (const CellIndex cell : {CellIndex{2, 2}, {1, 2}, {3, 2}, {2, 1}, {2, 3}})
    EXPECT_EQ(shade[grid.index(cell)], flat);
  EXPECT_NE(shade[grid.index(1, 1)], flat);
}

TEST(HillShade, OfASingleCellIsFlat) { EXPECT_EQ(hill_shade(GridGeometry(0, 0, 1, 1, 1), {3})[0], flat); }

double brightness(const Rgb& c) { return 0.299 * c[0] + 0.587 * c[1] + 0.114 * c[2]; }

TEST(Colour, SandBecomesBrighterAllTheWay) {
  for (int i = 0; i < 100; ++i)
    EXPECT_LT(brightness(colour(Palette::sand, i / 100.0)),
              brightness(colour(Palette::sand, (i + 1) / 100.0)));
}

TEST(Colour, DivergingIsBlueBelowWhiteAtZeroRedAbove) {
  const Rgb low = colour(Palette::diverging, 0.1);
  const Rgb middle = colour(Palette::diverging, 0.5);
  const Rgb high = colour(Palette::diverging, 0.9);
  EXPECT_GT(low[2], low[0]);
  EXPECT_GT(high[0], high[2]);
  EXPECT_TRUE(middle[0] == middle[1] && middle[1] == middle[2] && middle[0] > 240);
}

TEST(Colour, ClampsAndShowsUnknownAsGrey) {
  EXPECT_EQ(colour(Palette::sand, -3), colour(Palette::sand, 0));
  EXPECT_EQ(colour(Palette::sand, INFINITY), colour(Palette::sand, 1));
  const Rgb unknown = colour(Palette::diverging, NAN);
  EXPECT_TRUE(unknown[0] == unknown[1] && unknown[1] == unknown[2]);
}

TEST(DisplayRange, LeavesOutTheOuterPercentiles) {
  HeightMap::Layer values{nan, INFINITY};
  for (int i = 0; i <= 100; ++i) values.push_back(static_cast<float>(i));
  const ValueRange range = display_range(values, Palette::sand);
  EXPECT_EQ(range.low, 2);
  EXPECT_EQ(range.high, 98);
}

TEST(DisplayRange, IsSymmetricForTheDivergingPalette) {
  const ValueRange range = display_range({-5, 1, 2}, Palette::diverging);
  EXPECT_EQ(range.low, -5);
  EXPECT_EQ(range.high, 5);
}

TEST(DisplayRange, ShowsTheFewValuesThatAreNotZero) {
  HeightMap::Layer values(1000, 0.0F);
  values[3] = -0.4F;
  const ValueRange range = display_range(values, Palette::diverging);
  EXPECT_FLOAT_EQ(static_cast<float>(range.high), 0.4F);
  EXPECT_FLOAT_EQ(static_cast<float>(range.low), -0.4F);
  EXPECT_FALSE(std::signbit(display_range({0, 0}, Palette::diverging).low));
}

TEST(DisplayRange, OfNothingIsZero) {
  for (const Palette palette : {Palette::sand, Palette::diverging}) {
    EXPECT_EQ(display_range({nan, nan}, palette).low, 0);
    EXPECT_EQ(display_range({nan, nan}, palette).high, 0);
  }
}

TEST(ShadedColours, KeepThePaletteOnFlatGroundAndFollowTheReliefElsewhere) {
  const GridGeometry grid(0, 0, 1, 3, 3);
  const HeightMap::Layer values(grid.size(), 0.5F);
  const ValueRange range{0, 1};
  const Rgb plain = colour(Palette::sand, 0.5);
  EXPECT_EQ(shaded_colours(grid, values, Palette::sand, range)[4], plain);
  const auto lit = sloping_plane(grid, 0.5, -0.5);
  const auto dark = sloping_plane(grid, -0.5, 0.5);
  EXPECT_GT(brightness(shaded_colours(grid, values, Palette::sand, range, &lit)[4]), brightness(plain));
  EXPECT_LT(brightness(shaded_colours(grid, values, Palette::sand, range, &dark)[4]), brightness(plain));
}

}  // namespace
}  // namespace aeolian
