#include "aeolian_twin/nodes/drawn_wind.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using visualization_msgs::Marker;

const GridGeometry grid(100, 200, 0.5, 96, 48);
const HeightMap::Layer flat(grid.size(), 3);

std::vector<Marker> drawn(const WindField& wind, const HeightMap::Layer& heights = flat) {
  SurfaceLook look;
  look.offset = {5, 0, 0};
  return draw_wind(wind, {grid, heights, heights}, look, {}).markers;
}

TEST(DrawnWind, OverLevelGroundArrowsAreEqualAndStreamlinesStraight) {
  WindField wind;
  wind.friction_velocity = 0.4;
  wind.direction = M_PI / 6;
  const std::vector<Marker> markers = drawn(wind);
  ASSERT_EQ(markers.size(), 2U);
  EXPECT_EQ(markers[0].ns, "arrows");
  EXPECT_EQ(markers[0].points.size(), 24U * 12 * 6) << "a shaft and two lines of its head each";
  EXPECT_EQ(markers[0].pose.position.x, 105);
  for (const Marker& lines : markers)
    for (std::size_t i = 0; i + 1 < lines.points.size(); i += lines.ns == "arrows" ? 6 : 2)
      EXPECT_NEAR(
          std::atan2(lines.points[i + 1].y - lines.points[i].y, lines.points[i + 1].x - lines.points[i].x),
          M_PI / 6, 1e-6);
  EXPECT_GT(markers[1].points.size(), 1000U);
}

TEST(DrawnWind, EndsWhereTheAirSeparatesAndWhereNothingIsKnown) {
  WindField wind;
  wind.cells = HeightMap(grid);
  wind.cells.add("direction", 0);
  HeightMap::Layer& friction = wind.cells.add("friction_velocity", 0.3F);
  HeightMap::Layer heights = flat;
  for (int y = 0; y < grid.ny(); ++y)
    for (int x = 40; x < 60; ++x) {
      friction[grid.index(x, y)] = x < 50 ? 0 : HeightMap::unknown;
      if (x >= 55) heights[grid.index(x, y)] = HeightMap::unknown;
    }
  for (const Marker& lines : drawn(wind, heights)) {
    ASSERT_FALSE(lines.points.empty());
    for (std::size_t i = 0; i < lines.points.size(); i += 2) {
      const double middle = (lines.points[i].x + lines.points[i + 1].x) / 2;
      EXPECT_TRUE(middle < 20.6 || middle > 29.4) << middle;
      EXPECT_TRUE(std::isfinite(lines.points[i].z));
    }
  }
  EXPECT_EQ(drawn(WindField{})[0].action, Marker::DELETE) << "a calm takes the arrows away";
}

}  // namespace
}  // namespace aeolian
