#include "aeolian_twin/nodes/drawn_crests.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

const GridGeometry grid(10, 20, 0.002, 500, 250);
constexpr double wavelength = 0.1;  // m

visualization_msgs::Marker crests_of(const HeightMap::Layer& heights, const SurfaceLook& look) {
  return draw_crests({grid, heights, heights}, look, 0, std_msgs::Header());
}

TEST(DrawnCrests, LieOnTheCrestsOfASinusoid) {
  HeightMap::Layer heights(grid.size());
  for (std::size_t i = 0; i < heights.size(); ++i)
    heights[i] =
        static_cast<float>(0.004 * std::cos(2 * M_PI * (grid.x(grid.cell_at(i).x) - 10.05) / wavelength));
  SurfaceLook look;
  look.exaggeration = 3;
  look.offset = {1, -2, 0.5};
  const visualization_msgs::Marker lines = crests_of(heights, look);
  ASSERT_EQ(lines.action, visualization_msgs::Marker::ADD);
  ASSERT_GT(lines.points.size(), 100U);
  EXPECT_EQ(lines.points.size() % 2, 0U);
  double length = 0;
  for (std::size_t i = 0; i < lines.points.size(); ++i) {
    const geometry_msgs::Point& p = lines.points[i];
    const double off = std::remainder(lines.pose.position.x + p.x - 1 - 10.05, wavelength);
    EXPECT_NEAR(off, 0, 0.002);
    EXPECT_NEAR(p.z, 3 * 0.008, 3e-4) << "exaggerated as the mesh is";
    if (i % 2 == 1) length += std::hypot(p.x - lines.points[i - 1].x, p.y - lines.points[i - 1].y);
  }
  EXPECT_NEAR(length, 10 * 0.5, 0.75) << "ten crests across a map 0.5 m wide";
  EXPECT_NEAR(lines.pose.position.y, 18, 1e-9);
}

TEST(DrawnCrests, ABedWithoutRipplesTakesTheLinesAway) {
  HeightMap::Layer heights(grid.size());
  RandomStream random(1, 0);
  for (float& z : heights) z = static_cast<float>(0.001 * random.uniform());
  EXPECT_EQ(crests_of(heights, {}).action, visualization_msgs::Marker::DELETE);
  const HeightMap::Layer unknown(grid.size(), HeightMap::unknown);
  EXPECT_EQ(crests_of(unknown, {}).action, visualization_msgs::Marker::DELETE);
}

}  // namespace
}  // namespace aeolian
