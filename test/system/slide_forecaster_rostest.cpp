/// slide_forecaster beside height_mapper: events on the live map, piles that go back into it, and what it
/// refuses.
#include <cmath>
#include <limits>

#include "ros_test.hpp"
#include <geometry_msgs/TransformStamped.h>
#include <grid_map_msgs/GridMap.h>
#include <grid_map_msgs/SetGridMap.h>
#include <gtest/gtest.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Trigger.h>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

using grid_map_msgs::GridMap;
constexpr double event_takes = 60;  ///< at most, on a busy machine [s]

class SlideForecasterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(wait_until([&] {
      return points_.getNumSubscribers() > 0 && slabs_.getNumSubscribers() > 0 &&
             own_maps_.getNumSubscribers() > 0 && piles_.connected() && maps_.connected();
    }));
  }

  /// The panel 0.33 m above the origin at 40 degrees, and a scanner that looks down from 2 m.
  void send_frames(double height = 0.33, double roll = 0) {
    const double tilt = 40 * M_PI / 180;
    Eigen::Isometry3d panel = Eigen::Isometry3d::Identity();
    panel.translation().z() = height;
    panel.linear() = (Eigen::AngleAxisd(tilt, Eigen::Vector3d::UnitY()) *
                      Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()))
                         .toRotationMatrix();
    send(panel, "panel");
    Eigen::Isometry3d scanner = Eigen::Isometry3d::Identity();
    scanner.translation().z() = 2;
    send(scanner, "scanner");
  }
  void send(const Eigen::Isometry3d& pose, const std::string& child) {
    geometry_msgs::TransformStamped transform = tf2::eigenToTransform(pose);
    transform.header.frame_id = "map";
    transform.header.stamp = ros::Time::now();
    transform.child_frame_id = child;
    broadcaster_.sendTransform(transform);
  }

  /// Level ground at z = 0, measured.
  void scan() {
    PointCloud cloud;
    for (double x = -0.495; x < 1.5; x += 0.01)
      for (double y = -0.395; y < 0.4; y += 0.01)
        cloud.push_back(static_cast<float>(x), static_cast<float>(y), -2);
    auto message = to_message(cloud);
    message.header.frame_id = "scanner";
    message.header.stamp = ros::Time::now();
    points_.publish(message);
  }
  bool ground_is_known() {
    const bool known = wait_until([&] {
      scan();
      ros::WallDuration(0.2).sleep();
      ros::spinOnce();
      return !maps_.messages.empty();
    });
    return known && diagnostics_.is_well("height_mapper");
  }
  void slide(double thickness) {
    std_msgs::Float64 message;
    message.data = thickness;
    slabs_.publish(message);
  }
  std_srvs::Trigger::Response call(const std::string& service) {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::call(service, trigger)) << service;
    return trigger.response;
  }
  static double highest(const HeightMap& map) {
    float result = -1;
    for (const float z : map.layer(layer::elevation))
      if (std::isfinite(z)) result = std::max(result, z);
    return static_cast<double>(result);
  }

  ros::NodeHandle nh_;
  ros::Publisher points_ = nh_.advertise<sensor_msgs::PointCloud2>("points", 10);
  ros::Publisher slabs_ = nh_.advertise<std_msgs::Float64>("slab", 10);
  ros::Publisher own_maps_ = nh_.advertise<GridMap>("height_map", 1);
  Listener<GridMap> piles_{nh_, "pile"};
  Listener<GridMap> maps_{nh_, "height_map"};
  Diagnostics diagnostics_{nh_};
  tf2_ros::StaticTransformBroadcaster broadcaster_;
};

// The first test: there is no map, later there is one for good.
TEST_F(SlideForecasterTest, WaitsForAMap) {
  slide(0.02);
  EXPECT_TRUE(diagnostics_.warns("slide_forecaster", "there is no map yet on /height_map"));
  const auto answer = call("release");
  EXPECT_FALSE(answer.success);
  EXPECT_EQ(answer.message, "there is no map yet on /height_map");
}

TEST_F(SlideForecasterTest, PilesGrowAndGoIntoTheLiveMap) {
  send_frames();
  ASSERT_TRUE(ground_is_known());
  slide(0.02);
  ASSERT_TRUE(wait_until([&] { return !piles_.messages.empty(); }, event_takes));
  const HeightMap first = to_height_map(*piles_.messages.back());
  EXPECT_EQ(piles_.messages.back()->info.header.frame_id, "map");
  EXPECT_TRUE(first.has(layer::variance) && first.has(layer::ground));
  EXPECT_GT(highest(first), 0.02);
  EXPECT_LT(highest(first), 0.1);
  EXPECT_GT(first.geometry().origin_x(), -0.1) << "it slides to the east";

  // The live map has the pile with its variance; scans without the pile would be outliers at first.
  ASSERT_TRUE(wait_until([&] {
    return !maps_.messages.empty() &&
           std::abs(highest(to_height_map(*maps_.messages.back())) - highest(first)) < 1e-4;
  }));
  const HeightMap live = to_height_map(*maps_.messages.back());
  float most = 0;
  for (const float v : live.layer(layer::variance)) most = std::max(most, v);
  EXPECT_GT(most, 1e-5F);

  EXPECT_TRUE(call("release").success);
  ASSERT_TRUE(wait_until([&] { return piles_.messages.size() > 1; }, event_takes));
  const HeightMap second = to_height_map(*piles_.messages.back());
  EXPECT_GT(highest(second), highest(first)) << "the pile is carried on";
  for (const float z : second.layer(layer::ground))
    if (std::isfinite(z)) {
      EXPECT_NEAR(z, 0, 1e-3) << "the pile in the map is no ground";
    }
  EXPECT_TRUE(diagnostics_.is_well("slide_forecaster"));
}

TEST_F(SlideForecasterTest, SaysWhatItRefusesAndLivesOn) {
  send_frames();
  ASSERT_TRUE(ground_is_known());
  slide(0);
  EXPECT_TRUE(diagnostics_.warns("slide_forecaster", "thickness of the slab is 0, must be positive"));
  slide(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(diagnostics_.warns("slide_forecaster", "thickness of the slab is nan, must be positive"));

  HeightMap nothing(GridGeometry(-0.5, -0.4, 0.01, 200, 80));
  nothing.add(layer::elevation);
  std_msgs::Header header;
  header.stamp = ros::Time::now();
  header.frame_id = "odom";
  own_maps_.publish(to_message(nothing, header));
  EXPECT_TRUE(diagnostics_.warns("slide_forecaster", "/height_map: frame is 'odom', must be 'map'"));

  header.frame_id = "map";
  own_maps_.publish(to_message(nothing, header));
  ros::WallDuration(0.3).sleep();
  slide(0.02);
  EXPECT_TRUE(diagnostics_.warns("slide_forecaster", "ground: no cell of the map is known"));

  nothing.add(layer::elevation, 0);
  header.stamp += ros::Duration(1);
  own_maps_.publish(to_message(nothing, header));
  send_frames(0.05);
  ros::WallDuration(0.3).sleep();
  slide(0.02);
  EXPECT_TRUE(diagnostics_.warns("slide_forecaster", "the lower side of the panel above the ground is -"));
  send_frames(0.33, 0.3);
  ros::WallDuration(0.3).sleep();
  slide(0.02);
  EXPECT_TRUE(diagnostics_.warns("slide_forecaster", "the y axis of 'panel' leans by"));

  send_frames();
  ros::WallDuration(0.3).sleep();
  const std::size_t before = piles_.messages.size();
  EXPECT_TRUE(call("clear_pile").success);
  slide(0.03);
  EXPECT_TRUE(wait_until([&] { return piles_.messages.size() > before; }, event_takes)) << "it lives on";
  EXPECT_TRUE(diagnostics_.is_well("slide_forecaster"));
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "slide_forecaster_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
