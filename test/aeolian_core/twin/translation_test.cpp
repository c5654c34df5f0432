#include "aeolian_core/twin/translation.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

const GridGeometry grid(0, 0, 0.002, 200, 120);

/// Two ripples of different length, moved by `shift` along `direction`.
HeightMap::Layer ripples(double direction, double shift) {
  HeightMap::Layer z(grid.size());
  for (std::size_t i = 0; i < z.size(); ++i) {
    const CellIndex c = grid.cell_at(i);
    const double along = grid.x(c.x) * std::cos(direction) + grid.y(c.y) * std::sin(direction) - shift;
    z[i] = static_cast<float>(0.002 * std::sin(2 * M_PI * along / 0.08) +
                              0.001 * std::sin(2 * M_PI * along / 0.05));
  }
  return z;
}

class TranslationAlong : public testing::TestWithParam<double> {};

TEST_P(TranslationAlong, FindsTheShiftOfAMovedSurface) {
  const double direction = GetParam();
  const HeightMap::Layer start = ripples(direction, 0);
  for (const double shift : {0.0, 0.0103, -0.0171, 0.03}) {
    const Translation found = best_translation(grid, start, ripples(direction, shift), direction, 0.04);
    EXPECT_NEAR(found.shift, shift, 0.01 * 0.03) << direction;
    EXPECT_LT(found.rmse, 2e-5) << direction;  // what bilinear interpolation leaves
  }
}

INSTANTIATE_TEST_SUITE_P(Directions, TranslationAlong, testing::Values(0.0, M_PI / 2, -2.3, 0.4));

TEST(Translation, OfNothingIsExact) {
  HeightMap::Layer start = ripples(0.4, 0);
  for (std::size_t i = 0; i < start.size(); i += 3) start[i] = HeightMap::unknown;
  const Translation found = best_translation(grid, start, start, 0.4, 0.04);
  EXPECT_EQ(found.shift, 0);
  EXPECT_EQ(found.rmse, 0);
}

TEST(Translation, UnknownCellsAreLeftOut) {
  HeightMap::Layer start = ripples(0, 0);
  HeightMap::Layer target = ripples(0, 0.02);
  for (std::size_t i = 0; i < start.size(); i += 11) start[i] = HeightMap::unknown;
  for (std::size_t i = 0; i < start.size(); i += 7) target[i] = HeightMap::unknown;
  EXPECT_NEAR(best_translation(grid, start, target, 0, 0.04).shift, 0.02, 2e-4);
}

TEST(Translation, DoesNotWinByLookingAway) {
  // Only the first column agrees: a shift that compares little else would look perfect.
  HeightMap::Layer start(grid.size(), 0);
  HeightMap::Layer target(grid.size(), 1);
  for (int y = 0; y < grid.ny(); ++y) target[grid.index(grid.nx() - 1, y)] = 0;
  const Translation found = best_translation(grid, start, target, 0, grid.length_x());
  EXPECT_GT(found.rmse, 0.9);
}

}  // namespace
}  // namespace aeolian
