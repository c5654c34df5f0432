#include "aeolian_core/wind/lee_bubble.hpp"

#include "relief_worlds.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

std::vector<double> profile(double spacing, int n, const std::function<double(double)>& height) {
  std::vector<double> h;
  for (int i = 0; i < n; ++i) h.push_back(height(i * spacing));
  return h;
}

TEST(LeeBubble, BehindALevelBrinkIsOfTheLengthOfTheFormula) {
  const LeeBubble bubble{0.3, 0.2};
  for (const double height : {1.0, 2.0}) {
    std::vector<double> h = profile(0.05, 1200, [&](double x) { return x < 5 ? height : 0.0; });
    const std::vector<std::uint8_t> in = fill_bubbles(h, 0.05, bubble);
    double last = 0;
    double steepest = 0;
    for (std::size_t i = 1; i < h.size(); ++i) {
      if (in[i]) last = 0.05 * static_cast<double>(i);
      steepest = std::max(steepest, (h[i - 1] - h[i]) / 0.05);
    }
    EXPECT_NEAR(last - 5, 1.5 * height / 0.2, 0.2);  // 7.5 brinks
    EXPECT_NEAR(steepest, 0.2, 0.01);
  }
}

TEST(LeeBubble, GentleGroundAndHigherGroundStayAsTheyAre) {
  const LeeBubble bubble;
  std::vector<double> gentle = profile(1, 100, [](double x) { return 3 * std::sin(x / 15); });
  const std::vector<double> before = gentle;
  fill_bubbles(gentle, 1, bubble);
  EXPECT_EQ(gentle, before);
  // A second, higher step within the first one's bubble stands out of it.
  std::vector<double> two = profile(0.1, 400, [](double x) {
    return x < 5 ? 2.0 : x < 8 ? 0.0 : x < 12 ? 3.0 : 0.0;
  });
  const std::vector<std::uint8_t> in = fill_bubbles(two, 0.1, bubble);
  EXPECT_TRUE(in[60]);
  EXPECT_FALSE(in[100]);
  EXPECT_EQ(two[100], 3);
  EXPECT_TRUE(in[130]);
}

TEST(LeeBubble, EndsWithTheProfile) {
  std::vector<double> h = profile(1, 12, [](double x) { return x < 5 ? 100.0 : 0.0; });
  const std::vector<std::uint8_t> in = fill_bubbles(h, 1, LeeBubble{});
  EXPECT_TRUE(in.back());
  for (const double z : h) EXPECT_TRUE(z >= 0 && z <= 100);
}

TEST(LeeBubble, FollowsTheWind) {
  // A plateau's four edges: only the one downwind has a bubble, from whichever side the wind comes.
  const HeightMap map = world(
      81, 81, 1, [](double x, double y) { return std::max(std::abs(x), std::abs(y)) < 15.5 ? 4.0 : 0.0; });
  const WindRelief relief = wind_relief(map, 0);
  for (int quarter = 0; quarter < 4; ++quarter) {
    const double angle = quarter * M_PI / 2;
    const ShelteredRelief s = sheltered(relief, angle, LeeBubble{});
    ASSERT_FALSE(s.separated.empty());
    const auto at = [&](double distance) {
      const CellIndex c = *map.geometry().find(distance * std::cos(angle), distance * std::sin(angle));
      return s.separated[map.geometry().index(c)];
    };
    EXPECT_TRUE(at(22));
    EXPECT_FALSE(at(-22));
    EXPECT_FALSE(at(0));
  }
  const ShelteredRelief oblique = sheltered(relief, M_PI / 4, LeeBubble{});
  EXPECT_TRUE(oblique.separated[map.geometry().index(*map.geometry().find(18, 18))]);
  EXPECT_FALSE(oblique.separated[map.geometry().index(*map.geometry().find(-18, -18))]);
}

}  // namespace
}  // namespace aeolian
