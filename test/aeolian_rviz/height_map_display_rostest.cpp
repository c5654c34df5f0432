// rviz itself draws maps of 1000 x 1000 cells that come ten times a second, and the picture is looked at.
#include <cmath>
#include <limits>
#include <string>

#include "aeolian_rviz/rviz_off_screen.hpp"
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

#include "aeolian_core/surface/submap.hpp"
#include "aeolian_core/surface/tile_mask.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

constexpr int cells = 1000;
constexpr double cell = 0.002;  // m
constexpr int width = 1000;     // of the screen
constexpr int height = 800;
constexpr double pixels_per_metre = 350;  // of the view in height_map_display.rviz, which looks down

const GridGeometry grid(500000, 4e6, cell, cells, cells);
const CellRange patch{100, 300, 700, 900};
const CellRange hole{700, 900, 100, 300};

void fill(HeightMap& map, const CellRange& range, const std::string& name, float value) {
  for (int y = range.y0; y < range.y1; ++y)
    for (int x = range.x0; x < range.x1; ++x) map.layer(name)[grid.index(x, y)] = value;
}

/// A dune with a hole; blue (too low) in the west, white in the middle, red (too high) in the east.
HeightMap world() {
  HeightMap map(grid);
  HeightMap::Layer& heights = map.add(layer::elevation);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const CellIndex c = grid.cell_at(i);
    heights[i] = static_cast<float>(0.1 * std::sin(M_PI * c.x / cells) * std::sin(M_PI * c.y / cells));
  }
  map.add("difference", 0);
  fill(map, {0, 400, 0, cells}, "difference", -0.8F);
  fill(map, {600, cells, 0, cells}, "difference", 0.8F);
  fill(map, hole, layer::elevation, HeightMap::unknown);
  return map;
}

using Pixel = Picture::Pixel;
bool is_blue(const Pixel& p) { return p.blue > p.red + 60 && p.blue > p.green; }
bool is_red(const Pixel& p) { return p.red > p.blue + 60 && p.red > p.green + 60; }
bool is_white(const Pixel& p) { return p.red > 235 && p.green > 235 && p.blue > 235; }
bool is_background(const Pixel& p) { return p.red == 10 && p.green == 200 && p.blue == 10; }

/// The pixel that shows a cell.
Pixel pixel_of(const Picture& picture, int x, int y) {
  const double east = (x + 0.5 - cells / 2) * cell;
  const double north = (y + 0.5 - cells / 2) * cell;
  return picture.at(static_cast<int>(width / 2 + east * pixels_per_metre),
                    static_cast<int>(height / 2 - north * pixels_per_metre));
}

Pixel middle_of(const Picture& picture, const CellRange& range) {
  return pixel_of(picture, (range.x0 + range.x1) / 2, (range.y0 + range.y1) / 2);
}

class HeightMapDisplayTest : public RvizOffScreen {
 protected:
  HeightMapDisplayTest() { header_.frame_id = "map"; }
  static void SetUpTestSuite() {
    open_rviz(width, height,
              {"--fullscreen", "-d", AEOLIAN_REPOSITORY "/test/aeolian_rviz/height_map_display.rviz"});
  }

  /// Publishes ten times a second until the picture is as it should be.
  template <class Right>
  testing::AssertionResult shows(const HeightMap& map, Right&& right) {
    const grid_map_msgs::GridMap message = to_message(map, header_);
    return wait([&] { whole_.publish(message); }, right);
  }
  template <class Publish, class Right>
  testing::AssertionResult wait(Publish&& publish, Right&& right) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(100);
    Picture picture;
    while (ros::ok() && ros::WallTime::now() < end) {
      for (int i = 0; i < 5; ++i) {
        publish();
        ros::spinOnce();
        ros::WallDuration(0.1).sleep();
      }
      picture = take_picture();
      if (right(picture)) return testing::AssertionSuccess();
    }
    const auto told = [&](int x, int y) {
      const Pixel p = pixel_of(picture, x, y);
      return "(" + std::to_string(p.red) + ", " + std::to_string(p.green) + ", " + std::to_string(p.blue) +
             ")";
    };
    return testing::AssertionFailure()
           << "west is " << told(200, 500) << ", middle " << told(500, 500) << ", east " << told(800, 500)
           << ", patch " << told(200, 800) << ", hole " << told(800, 200) << ", outside " << told(-100, 500);
  }

  ros::NodeHandle nh_;
  ros::Publisher whole_ = nh_.advertise<grid_map_msgs::GridMap>("height_map", 1, /*latch=*/true);
  ros::Publisher parts_ = nh_.advertise<grid_map_msgs::GridMap>("height_map_updates", 10);
  ros::Publisher forecast_ = nh_.advertise<grid_map_msgs::GridMap>("forecast", 1, /*latch=*/true);
  std_msgs::Header header_;
};

TEST_F(HeightMapDisplayTest, ShowsTheSignOfTheDifferenceAndTheHole) {
  EXPECT_TRUE(shows(world(), [](const Picture& p) {
    return is_blue(pixel_of(p, 200, 500)) && is_white(pixel_of(p, 500, 500)) &&
           is_red(pixel_of(p, 800, 500)) && is_blue(pixel_of(p, 4, 4)) && is_red(pixel_of(p, 995, 995)) &&
           is_background(middle_of(p, hole)) && is_background(pixel_of(p, hole.x0 + 6, hole.y0 + 6)) &&
           is_red(pixel_of(p, hole.x0 - 6, hole.y0 - 6)) && is_background(pixel_of(p, -10, 500)) &&
           is_background(pixel_of(p, 500, 1010));
  }));
}

TEST_F(HeightMapDisplayTest, FollowsWholeMapsAndParts) {
  HeightMap map = world();
  fill(map, patch, "difference", 0.8F);
  EXPECT_TRUE(shows(map, [](const Picture& p) {
    return is_red(middle_of(p, patch)) && is_blue(pixel_of(p, patch.x0 - 10, 800));
  }));
  // Part of the patch back, and the hole is filled.
  const CellRange back{200, 250, 750, 850};
  fill(map, back, "difference", -0.8F);
  fill(map, hole, layer::elevation, 0);
  const auto send_parts = [&] {
    header_.stamp = ros::Time::now();
    for (const CellRange& range : {back, hole}) parts_.publish(to_message(submap(map, range), header_));
  };
  EXPECT_TRUE(wait(send_parts, [&](const Picture& p) {
    return is_blue(middle_of(p, back)) && is_red(pixel_of(p, 150, 800)) && is_red(middle_of(p, hole));
  }));
}

TEST_F(HeightMapDisplayTest, KeepsTheLastGoodSurfaceThroughForeignMaps) {
  ASSERT_TRUE(shows(world(), [](const Picture& p) { return is_blue(middle_of(p, patch)); }));
  HeightMap other(grid);
  other.add("temperature", 1);
  grid_map_msgs::GridMap empty;
  empty.info.header.frame_id = "map";
  grid_map_msgs::GridMap torn = to_message(world(), header_);
  torn.data[0].data.resize(17);
  grid_map_msgs::GridMap endless = to_message(world(), header_);
  endless.info.resolution = std::numeric_limits<double>::quiet_NaN();
  for (const auto& bad : {to_message(other, header_), empty, torn, endless})
    EXPECT_TRUE(
        wait([&, stamped = bad]() mutable { whole_.publish(stamped); },
             [](const Picture& p) { return is_blue(middle_of(p, patch)) && is_red(pixel_of(p, 800, 500)); }));
  HeightMap map = world();
  fill(map, patch, "difference", 0.8F);
  EXPECT_TRUE(shows(map, [](const Picture& p) { return is_red(middle_of(p, patch)); }))
      << "and takes good ones again";
}

TEST_F(HeightMapDisplayTest, FlickersBetweenMeasuredAndPredicted) {
  HeightMap predicted = world();
  fill(predicted, patch, "difference", 0.8F);
  const auto send_both = [&, measured = to_message(world(), header_),
                          forecast = to_message(predicted, header_)] {
    whole_.publish(measured);
    forecast_.publish(forecast);
  };
  for (int turn = 0; turn < 2; ++turn) {
    EXPECT_TRUE(wait(send_both, [](const Picture& p) { return is_red(middle_of(p, patch)); })) << "predicted";
    EXPECT_TRUE(wait(send_both, [](const Picture& p) { return is_blue(middle_of(p, patch)); })) << "measured";
  }
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "height_map_display_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
