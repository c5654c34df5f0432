/// forecast_shelf as a program: which forecast it shows, to whom, and what it refuses.
#include <limits>

#include "ros_test.hpp"
#include <aeolian_msgs/ForecastHorizons.h>
#include <grid_map_msgs/GridMap.h>
#include <std_msgs/Float64.h>

#include "aeolian_core/twin/difference.hpp"
#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using grid_map_msgs::GridMap;

const GridGeometry grid(0, 0, 0.01, 20, 10);

class ForecastShelfTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(wait_until([&] {
      return forecast_.getNumSubscribers() > 0 && difference_.getNumSubscribers() > 0 &&
             choice_.getNumSubscribers() > 0 && horizons_.connected();
    }));
  }

  static void send(const ros::Publisher& to, const HeightMap& map, double stamp,
                   const std::string& frame = "map") {
    std_msgs::Header header;
    header.frame_id = frame;
    header.stamp = ros::Time(stamp);
    to.publish(to_message(map, header));
  }
  /// A flat bed of some height, so that each forecast can be told from the others.
  static HeightMap flat(float height, float lead_time, const std::string& name = layer::elevation) {
    HeightMap map(grid);
    map.add(name, height);
    map.add(layer::lead_time, lead_time);
    return map;
  }
  void send_run(double start, float height) {
    for (const float lead : {30.0F, 60.0F, 300.0F})
      send(forecast_, flat(height + lead, lead), start + static_cast<double>(lead));
  }
  void choose(double lead_time) {
    std_msgs::Float64 message;
    message.data = lead_time;
    choice_.publish(message);
  }
  static float value(const Listener<GridMap>& listener, const std::string& name = layer::elevation) {
    return listener.messages.empty() ? -1 : to_height_map(*listener.messages.back()).layer(name)[0];
  }
  bool told(std::size_t horizons, double chosen) {
    return wait_until([&] {
      return !horizons_.messages.empty() && horizons_.messages.back()->lead_times.size() == horizons &&
             horizons_.messages.back()->chosen == chosen;
    });
  }

  ros::NodeHandle nh_;
  ros::Publisher forecast_ = nh_.advertise<GridMap>("forecast", 100);
  ros::Publisher difference_ = nh_.advertise<GridMap>("difference", 100);
  ros::Publisher map_ = nh_.advertise<GridMap>("height_map", 1, /*latch=*/true);
  ros::Publisher choice_ = nh_.advertise<std_msgs::Float64>("chosen_lead_time", 10);
  Listener<aeolian_msgs::ForecastHorizons> horizons_{nh_, "forecast_horizons"};
};

TEST_F(ForecastShelfTest, ShowsTheChosenHorizonOfTheNewestRun) {
  send_run(1000, 0);
  ASSERT_TRUE(told(3, 60));
  const aeolian_msgs::ForecastHorizons& all = *horizons_.messages.back();
  EXPECT_EQ(all.header.stamp, ros::Time(1000));
  EXPECT_EQ(all.lead_times, (std::vector<double>{30, 60, 300}));
  EXPECT_EQ(all.valid[2], ros::Time(1300));

  Listener<GridMap> shown(nh_, "chosen_forecast");
  ASSERT_TRUE(wait_until([&] { return value(shown) == 60; })) << "one who starts to look gets the last one";
  EXPECT_EQ(shown.messages.back()->info.header.stamp, ros::Time(1060));
  choose(250);
  ASSERT_TRUE(wait_until([&] { return value(shown) == 300; })) << "the nearest that there is";
  EXPECT_TRUE(told(3, 300));

  send_run(1030, 1000);
  ASSERT_TRUE(wait_until([&] { return value(shown) == 1300; }));
  EXPECT_EQ(shown.messages.size(), 3U) << "the other horizons are not shown";
  choose(300);
  EXPECT_FALSE(wait_until([&] { return shown.messages.size() > 3; }, 0.3)) << "nothing new was chosen";
}

TEST_F(ForecastShelfTest, TheDifferenceIsOfTheSameLeadTime) {
  Listener<GridMap> shown(nh_, "chosen_difference");
  send_run(2000, 0);
  for (const float lead : {30.0F, 60.0F}) send(difference_, flat(lead, lead, layer::difference), 2060);
  choose(30);
  ASSERT_TRUE(wait_until([&] { return value(shown, layer::difference) == 30; }));
  choose(300);
  ASSERT_TRUE(wait_until([&] { return value(shown, layer::difference) == 60; })) << "none of 300 s yet";
  send(difference_, flat(300, 300, layer::difference), 2300);
  EXPECT_TRUE(wait_until([&] { return value(shown, layer::difference) == 300; }));
}

TEST_F(ForecastShelfTest, MeasuredNowIsFollowedWhileItIsLookedAt) {
  send_run(3000, 0);
  HeightMap measured(grid);
  measured.add(layer::elevation, 7);
  measured.add(layer::variance, 4);
  send(map_, measured, 3005);
  choose(0);
  ASSERT_TRUE(told(3, 0));
  EXPECT_FALSE(wait_until([&] { return map_.getNumSubscribers() > 0; }, 0.3)) << "nobody looks";
  {
    Listener<GridMap> shown(nh_, "chosen_forecast");
    ASSERT_TRUE(wait_until([&] { return value(shown) == 7; }));
    EXPECT_EQ(value(shown, "spread"), 2) << "standard deviation of the measurement";
    EXPECT_EQ(value(shown, layer::lead_time), 0);
    measured.add(layer::elevation, 8);
    send(map_, measured, 3010);
    ASSERT_TRUE(wait_until([&] { return value(shown) == 8; }));
    choose(60);
    ASSERT_TRUE(wait_until([&] { return value(shown) == 60; }));
    EXPECT_TRUE(wait_until([&] { return map_.getNumSubscribers() == 0; })) << "it is not looked at";
    choose(0);
    ASSERT_TRUE(wait_until([&] { return value(shown) == 8; }));
  }
  EXPECT_TRUE(wait_until([&] { return map_.getNumSubscribers() == 0; })) << "nobody looks";
}

TEST_F(ForecastShelfTest, SaysWhatItRefusesAndKeepsWhatItHas) {
  Diagnostics diagnostics(nh_);
  send_run(4000, 0);
  choose(60);
  ASSERT_TRUE(told(3, 60));
  choose(-1);
  EXPECT_TRUE(diagnostics.warns("forecast_shelf", "chosen_lead_time: -1, must be a lead time [s]"));
  choose(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(diagnostics.warns("forecast_shelf", "chosen_lead_time: nan, must be"));
  choose(60);
  EXPECT_TRUE(diagnostics.is_well("forecast_shelf"));

  HeightMap no_lead(grid);
  no_lead.add(layer::elevation, 1);
  send(forecast_, no_lead, 4060);
  EXPECT_TRUE(diagnostics.warns("forecast_shelf", "'lead_time'"));
  send(forecast_, flat(1, std::numeric_limits<float>::quiet_NaN()), 4060);
  EXPECT_TRUE(diagnostics.warns("forecast_shelf", "'lead_time' has no time above 0 s"));
  send(forecast_, flat(1, 60), 4060, "odom");
  EXPECT_TRUE(diagnostics.warns("forecast_shelf", "/forecast: frame is 'odom', must be 'map'"));
  send(forecast_, flat(1, 60), 10);
  EXPECT_TRUE(diagnostics.warns("forecast_shelf",
                                "/forecast: stamp is 10 s, must be at least the lead time of 60 s"));

  Listener<GridMap> shown(nh_, "chosen_forecast");
  EXPECT_TRUE(wait_until([&] { return value(shown) == 60; }));
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "forecast_shelf_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
