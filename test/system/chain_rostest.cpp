/// From wind and height maps to forecasts and their scores, with all nodes as nodelets of one manager.
#include <cmath>
#include <limits>

#include "ros_test.hpp"
#include <aeolian_msgs/Comparison.h>
#include <geometry_msgs/TransformStamped.h>
#include <geometry_msgs/TwistStamped.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/twin/forecast.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

const GridGeometry geometry(0, 0, 0.005, 64, 32);

HeightMap ripples() {
  HeightMap map(geometry);
  HeightMap::Layer& elevation = map.add(layer::elevation);
  for (std::size_t i = 0; i < elevation.size(); ++i)
    elevation[i] =
        static_cast<float>(0.01 + 0.002 * std::sin(2 * M_PI * geometry.x(geometry.cell_at(i).x) / 0.08));
  return map;
}

class ChainTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const char* node : {"wind_estimator", "forecaster", "comparator", "surface_display"})
      ASSERT_TRUE(diagnostics_.is_up(node)) << node;
    ASSERT_TRUE(wait_until([&] {
      return wind_.getNumSubscribers() > 0 && maps_.getNumSubscribers() > 0 && fields_.connected() &&
             forecasts_.connected() && comparisons_.connected() && differences_.connected() &&
             meshes_.connected();
    }));
    differences_.messages.clear();  // the latched one of the test before
    meshes_.messages.clear();
  }

  /// Readings once a second, from one time to another.
  void blow(double from, double to, double east, double north = 0, const std::string& frame = "map") {
    geometry_msgs::TwistStamped m;
    m.header.frame_id = frame;
    m.twist.linear.x = east;
    m.twist.linear.y = north;
    for (double t = from; t <= to; ++t) {
      m.header.stamp = ros::Time(t);
      const std::size_t before = fields_.messages.size();
      wind_.publish(m);
      wait_until([&] { return fields_.messages.size() > before; }, std::isfinite(east) ? 5 : 0.2);
    }
  }

  void send_map(const HeightMap& map, const ros::Time& stamp) {
    std_msgs::Header header;
    header.frame_id = "map";
    header.stamp = stamp;
    maps_.publish(to_message(map, header));
  }

  ros::NodeHandle nh_;
  tf2_ros::StaticTransformBroadcaster tf_;
  ros::Publisher wind_ = nh_.advertise<geometry_msgs::TwistStamped>("wind", 100);
  ros::Publisher maps_ = nh_.advertise<grid_map_msgs::GridMap>("height_map", 10);
  Listener<grid_map_msgs::GridMap> fields_{nh_, "wind_field"};
  Listener<grid_map_msgs::GridMap> forecasts_{nh_, "forecast"};
  Listener<aeolian_msgs::Comparison> comparisons_{nh_, "comparison"};
  Listener<grid_map_msgs::GridMap> differences_{nh_, "difference"};
  Listener<visualization_msgs::MarkerArray> meshes_{nh_, "mesh"};
  Listener<sensor_msgs::PointCloud2> clouds_{nh_, "cloud"};
  Diagnostics diagnostics_{nh_};
};

TEST_F(ChainTest, WindMovesRipplesAndTheForecastIsScored) {
  blow(1000, 1005, 8);
  const WindField field = to_wind_field(*fields_.messages.back());
  EXPECT_NEAR(field.friction_velocity, 0.4 * 8 / std::log(1 / (0.00025 / 30)), 1e-6);
  EXPECT_NEAR(field.direction, 0, 1e-6);
  EXPECT_EQ(fields_.messages.back()->data[0].data.size(), 1U);

  const ros::Time start(1005, 250000000);
  send_map(ripples(), start);
  ASSERT_TRUE(wait_until([&] { return forecasts_.messages.size() == 2; }));
  for (std::size_t i = 0; i < 2; ++i) {
    const double lead = i == 0 ? 2 : 4;
    EXPECT_EQ(forecasts_.messages[i]->info.header.stamp, start + ros::Duration(lead));
    const HeightMap forecast = to_height_map(*forecasts_.messages[i]);
    EXPECT_EQ(forecast.layer(layer::initial), ripples().layer(layer::elevation));
    EXPECT_EQ(forecast.layer(layer::lead_time)[0], static_cast<float>(lead));
    EXPECT_TRUE(forecast.layer(layer::elevation) != forecast.layer(layer::initial))
        << "the wind moved nothing";
  }

  // The measurement 1 mm below the forecast: a bias of 1 mm.
  for (const auto& message : forecasts_.messages) {
    HeightMap measured = to_height_map(*message);
    for (float& z : measured.layer(layer::elevation)) z -= 0.001F;
    send_map(measured, message->info.header.stamp + ros::Duration(0.1));
  }
  ASSERT_TRUE(
      wait_until([&] { return comparisons_.messages.size() == 2 && differences_.messages.size() == 2; }));
  for (std::size_t i = 0; i < 2; ++i) {
    const aeolian_msgs::Comparison& c = *comparisons_.messages[i];
    EXPECT_EQ(c.issued, start);
    EXPECT_EQ(c.lead_time, i == 0 ? 2 : 4);
    EXPECT_EQ(c.header.stamp, start + ros::Duration(c.lead_time));
    EXPECT_EQ(c.cells, geometry.size());
    EXPECT_NEAR(c.bias, 0.001, 1e-7);
    EXPECT_NEAR(c.rmse, 0.001, 1e-7);
    const HeightMap difference = to_height_map(*differences_.messages[i]);
    for (const float d : difference.layer("difference")) EXPECT_NEAR(d, 0.001, 1e-7);
  }

  ASSERT_TRUE(wait_until([&] { return !meshes_.messages.empty() && !clouds_.messages.empty(); }));
  ASSERT_EQ(meshes_.messages.back()->markers.size(), 6U);
  EXPECT_EQ(meshes_.messages.back()->markers[0].points.size(), 6U * 31 * 15) << "2048 cells are drawn as 512";
  EXPECT_EQ(meshes_.messages.back()->markers[1].text, "Predicted, 4 s ahead");
  EXPECT_EQ(clouds_.messages.back()->width, geometry.size());
  for (const char* node : {"wind_estimator", "forecaster", "comparator", "surface_display"})
    EXPECT_TRUE(diagnostics_.is_well(node));
}

TEST_F(ChainTest, BelowTheThresholdNothingMoves) {
  blow(1100, 1105, 2);
  send_map(ripples(), ros::Time(1105.5));
  ASSERT_TRUE(wait_until([&] { return forecasts_.messages.size() == 2; }));
  const HeightMap forecast = to_height_map(*forecasts_.messages.back());
  EXPECT_EQ(forecast.layer(layer::elevation), ripples().layer(layer::elevation));
}

TEST_F(ChainTest, TheAnemometersFrameGivesHeightAndDirection) {
  geometry_msgs::TransformStamped mast;
  mast.header.frame_id = "map";
  mast.header.stamp = ros::Time::now();
  mast.child_frame_id = "anemometer";
  mast.transform.translation.x = 0.16;  // in the middle, between trough and crest
  mast.transform.translation.y = 0.08;
  mast.transform.translation.z = 2.01;  // the ground of the ripples is at 0.01
  mast.transform.rotation.z = std::sqrt(0.5);
  mast.transform.rotation.w = std::sqrt(0.5);
  tf_.sendTransform(mast);
  send_map(ripples(), ros::Time(1190));
  ASSERT_TRUE(wait_until([&] {
    blow(1200, 1200, 0, -8, "anemometer");
    return std::abs(to_wind_field(*fields_.messages.back()).friction_velocity -
                    0.4 * 8 / std::log(2 / (0.00025 / 30))) < 1e-6;
  })) << to_wind_field(*fields_.messages.back()).friction_velocity;
  EXPECT_NEAR(to_wind_field(*fields_.messages.back()).direction, 0, 1e-6);
}

TEST_F(ChainTest, BadWindIsReportedAndSkipped) {
  blow(1300, 1300, 8);
  const std::size_t before = fields_.messages.size();
  blow(1301, 1301, std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(diagnostics_.warns("wind_estimator", "velocity is (nan, 0) m/s"));
  blow(1302, 1302, std::numeric_limits<double>::infinity());
  EXPECT_TRUE(diagnostics_.warns("wind_estimator", "velocity is (inf, 0) m/s"));
  EXPECT_EQ(fields_.messages.size(), before);
  blow(1310, 1310, 8);
  EXPECT_TRUE(diagnostics_.warns("wind_estimator", "gap of 8.0 s"));

  // Readings at 1300 and 1310 only: the gap is bridged, and said.
  send_map(ripples(), ros::Time(1312));
  EXPECT_TRUE(diagnostics_.warns("forecaster", "a gap of 10.0 s in the wind is bridged"));
  EXPECT_TRUE(wait_until([&] { return forecasts_.messages.size() == 2; }));
  send_map(ripples(), ros::Time(1390));
  EXPECT_TRUE(diagnostics_.warns("forecaster", "no wind in the 5 s before the map at 1390"));
}

TEST_F(ChainTest, AMapOfAnotherFrameIsRefused) {
  grid_map_msgs::GridMap message = to_message(ripples(), std_msgs::Header());
  message.info.header.frame_id = "odom";
  maps_.publish(message);
  EXPECT_TRUE(diagnostics_.warns("forecaster", "frame is 'odom', must be 'map'"));
}

TEST_F(ChainTest, ForecastsThatNobodyMeasuredAreDroppedAndTimeMayJumpBack) {
  blow(1500, 1505, 8);
  send_map(ripples(), ros::Time(1505.5));
  ASSERT_TRUE(wait_until([&] { return forecasts_.messages.size() == 2; }));
  send_map(ripples(), ros::Time(1509));  // 0.5 s before the second is due, 1.5 s after the first
  EXPECT_TRUE(
      diagnostics_.warns("comparator", "a forecast for 1507.500000000: the nearest map is 1.50 s away"));
  send_map(ripples(), ros::Time(1000));
  EXPECT_TRUE(diagnostics_.warns("comparator",
                                 "time jumped back (a bag that loops?): 1 waiting forecasts were dropped"));
  EXPECT_TRUE(comparisons_.messages.empty());
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "chain_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
