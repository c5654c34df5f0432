#include "aeolian_twin/nodes/map_legend.hpp"

#include <gtest/gtest.h>

namespace aeolian {
namespace {

using visualization_msgs::Marker;

TEST(ValueWords, AreMillimetresUnlessTheRangeIsLarge) {
  EXPECT_EQ(value_words(-0.0036, {-0.0036, 0.0036}), "-3.6 mm");
  EXPECT_EQ(value_words(-1e-9, {-0.0036, 0.0036}), "0 mm");
  EXPECT_EQ(value_words(0.00021, {0.00021, 0.00048}), "0.21 mm") << "two values of a narrow range differ";
  EXPECT_EQ(value_words(0.12, {0, 0.12}), "120 mm");
  EXPECT_EQ(value_words(1.234, {0.5, 1.234}), "1.23 m");
  EXPECT_EQ(value_words(0.001, {0.001, 0.001}), "1.0 mm") << "flat ground";
  EXPECT_EQ(value_words(0.31, {0.1, 0.31}, "m/s"), "0.31 m/s");
}

TEST(MapLegend, ItsBarHasTheColoursOfTheValuesWrittenBelow) {
  const GridGeometry grid(10, 20, 0.01, 100, 50);
  SurfaceLook look;
  look.palette = Palette::diverging;
  look.range = {-0.002, 0.002};
  look.offset = {2, 0, 0};
  const std::vector<Marker> markers = MapLegend{grid, look, 0.5, "Difference", "m", {}}.markers();
  ASSERT_EQ(markers.size(), 5U);
  EXPECT_EQ(markers[0].text, "Difference");
  EXPECT_GT(markers[0].pose.position.y, 20.5) << "above the map";
  const Marker& bar = markers[1];
  ASSERT_EQ(bar.points.size(), bar.colors.size());
  EXPECT_GT(bar.colors.front().b, bar.colors.front().r + 0.2F) << "blue in the west";
  EXPECT_GT(bar.colors.back().r, bar.colors.back().b + 0.2F) << "red in the east";
  // Each label stands at the end or the middle of the bar that has its value.
  const std::array<std::string, 3> words{"-2.0 mm", "0 mm", "2.0 mm"};
  const std::array<double, 3> places{bar.points.front().x, 0.5, bar.points[bar.points.size() - 2].x};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(markers[2 + i].text, words[i]);
    EXPECT_NEAR(markers[2 + i].pose.position.x, 12 + places[i], 1e-9);
    EXPECT_LT(markers[2 + i].pose.position.y, 20) << "below the map";
  }
}

TEST(MapLegend, OnlyTheTitleTakesTheBarAway) {
  const GridGeometry grid(0, 0, 0.01, 100, 50);
  const SurfaceLook look;
  const MapLegend legend{grid, look, 0, "Uncertainty", "m", {}};
  const std::vector<Marker> with_bar = legend.markers();
  const std::vector<Marker> without = legend.only_title();
  ASSERT_EQ(with_bar.size(), without.size());
  EXPECT_EQ(without[0].action, Marker::ADD);
  for (std::size_t i = 1; i < without.size(); ++i) {
    EXPECT_EQ(without[i].action, Marker::DELETE);
    EXPECT_EQ(without[i].ns, with_bar[i].ns);
    EXPECT_EQ(without[i].id, with_bar[i].id);
  }
}

}  // namespace
}  // namespace aeolian
