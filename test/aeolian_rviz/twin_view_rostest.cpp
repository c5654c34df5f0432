// twin.launch and rviz/twin.rviz on maps of which one knows what their picture must show; the slider's panel.
#include <QApplication>
#include <QSlider>
#include <cmath>
#include <functional>
#include <string>

#include "aeolian_rviz/horizon_panel.hpp"
#include "aeolian_rviz/rviz_off_screen.hpp"
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <ros/ros.h>
#include <std_msgs/Float64.h>

#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using Pixel = Picture::Pixel;

constexpr int width = 1400;  // of the screen, as of the window in twin.rviz
constexpr int height = 900;
constexpr int enough = 300;  // pixels of a colour; none has a tenth of it by chance
const GridGeometry grid(0, 0, 0.002, 500, 250);

/// A quarter of the part of the window that shows maps.
struct Quarter {
  bool is_east;
  bool is_south;

  int count(const Picture& picture, const std::function<bool(const Pixel&)>& is) const {
    constexpr int left = 370, middle = 874, right = 1380, top = 70, centre = 399, bottom = 730;
    int result = 0;
    for (int y = is_south ? centre : top; y < (is_south ? bottom : centre); ++y)
      for (int x = is_east ? middle : left; x < (is_east ? right : middle); ++x)
        result += is(picture.at(x, y)) ? 1 : 0;
    return result;
  }
};
constexpr Quarter measured{false, false};
constexpr Quarter predicted{true, false};
constexpr Quarter difference_view{false, true};
constexpr Quarter uncertainty{true, true};

bool is_crest(const Pixel& p) { return p.red < 40 && p.green < 130 && p.blue > 160; }
bool is_blue(const Pixel& p) { return p.blue > p.red + 60 && p.blue > 110; }
bool is_red(const Pixel& p) { return p.red > p.blue + 60 && p.red > p.green + 60; }
bool is_yellow(const Pixel& p) { return p.red > 220 && p.green > 200 && p.blue < 80; }

HeightMap ripples(float metres) {
  HeightMap map(grid);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] = metres / 2 * static_cast<float>(std::sin(2 * M_PI * grid.cell_at(i).x / 50));
  return map;
}

/// A value in the western half and another in the eastern.
HeightMap::Layer halves(float west, float east) {
  HeightMap::Layer result(grid.size());
  for (std::size_t i = 0; i < result.size(); ++i) result[i] = grid.cell_at(i).x < 250 ? west : east;
  return result;
}

class TwinViewTest : public RvizOffScreen {
 protected:
  static void SetUpTestSuite() { open_rviz(width, height, {"-d", AEOLIAN_REPOSITORY "/rviz/twin.rviz"}); }

  static void send(const ros::Publisher& to, const HeightMap& map, double stamp) {
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = ros::Time(stamp);
    to.publish(to_message(map, header));
  }
  /// Forecasts from time 1000, as they come without and with an ensemble.
  void send_forecasts(bool with_spread) {
    for (const float lead : {30.0F, 120.0F}) {
      HeightMap map = ripples(0.008F);
      map.add(layer::lead_time, lead);
      if (with_spread) map.add("spread", halves(0.0002F, 0.0008F));
      send(forecast_, map, 1000 + static_cast<double>(lead));
    }
  }
  void send_difference() {
    HeightMap map = ripples(0);
    map.add(layer::difference, halves(-0.002F, 0.002F));
    map.add(layer::lead_time, 120);
    send(difference_, map, 1000);
  }

  /// Publishes again and again until the picture is as it should be.
  testing::AssertionResult shows(const std::function<void()>& publish,
                                 const std::function<bool(const Picture&)>& right) {
    const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(90);
    Picture picture;
    while (ros::ok() && ros::WallTime::now() < end) {
      publish();
      for (int i = 0; i < 10; ++i) {
        ros::spinOnce();
        ros::WallDuration(0.1).sleep();
      }
      picture = take_picture();
      if (right(picture)) return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
           << "crests " << measured.count(picture, is_crest) << " and " << predicted.count(picture, is_crest)
           << ", difference blue " << difference_view.count(picture, is_blue) << ", red "
           << difference_view.count(picture, is_red) << ", uncertainty yellow "
           << uncertainty.count(picture, is_yellow) << " pixels";
  }

  ros::NodeHandle nh_;
  ros::Publisher map_ = nh_.advertise<grid_map_msgs::GridMap>("height_map", 1, /*latch=*/true);
  ros::Publisher forecast_ = nh_.advertise<grid_map_msgs::GridMap>("forecast", 10);
  ros::Publisher difference_ = nh_.advertise<grid_map_msgs::GridMap>("difference", 10);
};

TEST_F(TwinViewTest, ShowsFourMapsWithCrestsAndFollowsTheSlider) {
  // Flat now, ripples ahead, and no ensemble.
  EXPECT_TRUE(shows(
      [&] {
        send(map_, ripples(0), 1000);
        send_forecasts(false);
        send_difference();
      },
      [](const Picture& p) {
        return measured.count(p, is_crest) < enough / 10 && predicted.count(p, is_crest) > enough &&
               difference_view.count(p, is_blue) > 10 * enough &&
               difference_view.count(p, is_red) > 10 * enough &&
               uncertainty.count(p, is_yellow) < enough / 10;
      }));
  EXPECT_TRUE(shows([&] { send_forecasts(true); },
                    [](const Picture& p) {
                      return uncertainty.count(p, is_yellow) > 10 * enough &&
                             predicted.count(p, is_crest) > enough;
                    }))
      << "an ensemble's spread";

  int arguments = 3;
  char program[] = "twin_view_rostest", platform[] = "-platform", off_screen[] = "offscreen";
  char* words[] = {program, platform, off_screen, nullptr};
  QApplication application(arguments, words);
  HorizonPanel panel;
  panel.onInitialize();
  auto* slider = panel.findChild<QSlider*>();
  ASSERT_TRUE(slider);
  EXPECT_TRUE(shows([] {}, [&](const Picture&) { return slider->maximum() == 2; })) << "two horizons and now";
  EXPECT_EQ(slider->value(), 2) << "as the shelf says";
  slider->setValue(0);
  EXPECT_TRUE(shows([] {}, [](const Picture& p) { return predicted.count(p, is_crest) < enough / 10; }))
      << "measured now: flat";
  slider->setValue(1);
  EXPECT_TRUE(shows([] {}, [](const Picture& p) { return predicted.count(p, is_crest) > enough; }));
  EXPECT_TRUE(shows([&] { send(map_, ripples(0.006F), 1001); },
                    [](const Picture& p) { return measured.count(p, is_crest) > enough; }))
      << "the wind has come";
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "twin_view_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
