#include "aeolian_core/grains/impacts/bed_surface.hpp"

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

constexpr double r = 0.01;

/// Hexagonal rows from left to right, each given by its first and last column.
GrainDynamics<2> rows(const std::vector<std::pair<int, int>>& spans) {
  GrainDynamics<2> grains(GrainWorld<2>{});
  for (std::size_t row = 0; row < spans.size(); ++row)
    for (int column = spans[row].first; column <= spans[row].second; ++column)
      grains.add({(2 * column + 1 + static_cast<double>(row % 2)) * r,
                  r + std::sqrt(3.) * r * static_cast<double>(row)},
                 r);
  return grains;
}

TEST(BedSurface, ALevelBedHasNoSteps) {
  const auto grains = rows({{0, 19}, {0, 19}});
  const BedSurface surface(grains, r, 0.41, 0);
  EXPECT_EQ(surface.roughness(), 0);
  EXPECT_NEAR(surface.top(), (2 + std::sqrt(3.)) * r, 1e-12);
  for (int column = 1; column < 20; ++column) {
    EXPECT_EQ(surface.layer(20 + column), 1);
    EXPECT_EQ(surface.layer(column), 2);
    EXPECT_EQ(surface.step(20 + column), Origin::other);
  }
}

TEST(BedSurface, APlateauHasAnAntiBrinkAndABrink) {
  const auto grains = rows({{0, 19}, {0, 19}, {6, 13}});  // the plateau: grains 40 to 47
  const BedSurface surface(grains, r, 0.41, 0);
  EXPECT_NEAR(surface.roughness(), 2 * r / 0.41, 1e-12);  // one brink
  EXPECT_EQ(surface.step(40), Origin::anti_brink);
  EXPECT_EQ(surface.step(41), Origin::anti_brink);
  EXPECT_EQ(surface.step(42), Origin::other);
  EXPECT_EQ(surface.step(45), Origin::other);
  EXPECT_EQ(surface.step(46), Origin::brink);
  EXPECT_EQ(surface.step(47), Origin::brink);
  for (int grain = 0; grain < 40; ++grain) EXPECT_EQ(surface.step(grain), Origin::other) << grain;
  EXPECT_EQ(surface.layer(44), 1);
  EXPECT_EQ(surface.layer(30), 2) << "below the plateau";
  EXPECT_EQ(surface.layer(38), 1) << "beside the plateau";
}

TEST(BedSurface, SpheresAroundAPeriodicRidge) {
  GrainWorld<3> world;
  world.period = {40 * r, 8 * r, 0};
  GrainDynamics<3> grains(world);
  const auto add = [&](double x, int line, double z) { return grains.add({x, (2 * line + 1) * r, z}, r); };
  for (int line = 0; line < 4; ++line)
    for (int column = 0; column < 20; ++column) add((2 * column + 1) * r, line, r);
  std::vector<std::vector<int>> ridge(4);  // over x = 0, where the bed begins anew
  for (int line = 0; line < 4; ++line)
    for (const double x : {36., 38., 0., 2., 4.})
      ridge[static_cast<std::size_t>(line)].push_back(add(x * r, line, 2.8 * r));
  const BedSurface surface(grains, r, 40 * r, 8 * r);
  EXPECT_NEAR(surface.roughness(), 1. / 20, 1e-12);
  for (const auto& line : ridge) {
    EXPECT_EQ(surface.step(line[0]), Origin::anti_brink);
    EXPECT_EQ(surface.step(line[1]), Origin::anti_brink);
    EXPECT_EQ(surface.step(line[2]), Origin::other);
    EXPECT_EQ(surface.step(line[3]), Origin::brink);
    EXPECT_EQ(surface.step(line[4]), Origin::brink);
  }
}

TEST(BedSurface, NoGrains) { EXPECT_THROW(BedSurface(GrainDynamics<2>(GrainWorld<2>{}), r, 1, 0), Error); }

}  // namespace
}  // namespace aeolian
