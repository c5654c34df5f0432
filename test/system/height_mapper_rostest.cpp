/// height_mapper as a program under a master: clouds and tf in, maps and diagnostics out.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include "ros_test.hpp"
#include "running_program.hpp"
#include <geometry_msgs/TransformStamped.h>
#include <grid_map_msgs/GetGridMap.h>
#include <grid_map_msgs/GridMap.h>
#include <grid_map_msgs/ProcessFile.h>
#include <grid_map_msgs/SetGridMap.h>
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_srvs/Empty.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"

namespace aeolian {
namespace {

constexpr double sigma = 0.001;
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

double plane(double x, double y) { return 0.05 + 0.1 * x - 0.05 * y; }

/// A scanner 1 m over the middle of the map that looks down: x as in the map, y and z turned over.
geometry_msgs::TransformStamped scanner_pose(const std::string& frame, const ros::Time& stamp) {
  geometry_msgs::TransformStamped pose;
  pose.header.frame_id = "map";
  pose.header.stamp = stamp;
  pose.child_frame_id = frame;
  pose.transform.translation.x = 0.2;
  pose.transform.translation.y = 0.1;
  pose.transform.translation.z = 1;
  pose.transform.rotation.x = 1;
  return pose;
}

sensor_msgs::PointCloud2 cloud_of(const std::vector<std::array<float, 3>>& points, const std::string& frame,
                                  const ros::Time& stamp) {
  sensor_msgs::PointCloud2 cloud;
  cloud.header.frame_id = frame;
  cloud.header.stamp = stamp;
  sensor_msgs::PointCloud2Modifier modifier(cloud);
  modifier.setPointCloud2FieldsByString(1, "xyz");
  modifier.resize(points.size());
  sensor_msgs::PointCloud2Iterator<float> xyz(cloud, "x");
  for (const auto& p : points) {
    std::copy(p.begin(), p.end(), &xyz[0]);
    ++xyz;
  }
  return cloud;
}

/// Nine noisy points in each cell of the tilted plane.
sensor_msgs::PointCloud2 plane_cloud(const ros::Time& stamp, const std::string& frame = "scanner") {
  RandomStream random(7, stamp.sec);
  std::vector<std::array<float, 3>> points;
  for (int i = 0; i < 120; ++i) {
    for (int j = 0; j < 60; ++j) {
      const double x = (i + 0.5) / 300;
      const double y = (j + 0.5) / 300;
      const double z = plane(x, y) + sigma * random.normal();
      points.push_back({static_cast<float>(x - 0.2), static_cast<float>(0.1 - y), static_cast<float>(1 - z)});
    }
  }
  return cloud_of(points, frame, stamp);
}

class HeightMapperTest : public ::testing::Test {
 protected:
  void SetUp() override {
    ASSERT_TRUE(wait_until([&] { return points_.getNumSubscribers() > 0 && maps_.connected(); }));
    tf_.sendTransform(scanner_pose("scanner", ros::Time::now()));
    call("clear_map");
    maps_.messages.clear();
  }

  static void call(const std::string& service) {
    std_srvs::Empty empty;
    EXPECT_TRUE(ros::service::waitForService(service, 10000));
    EXPECT_TRUE(ros::service::call(service, empty));
  }

  /// Of save_map or load_map.
  static bool process(const std::string& service, const std::string& file) {
    grid_map_msgs::ProcessFile request;
    request.request.file_path = file;
    EXPECT_TRUE(ros::service::call(service, request));
    return request.response.success;
  }

  bool is_newest(const ros::Time& stamp) const {
    return !maps_.messages.empty() && maps_.messages.back()->info.header.stamp == stamp;
  }

  /// The map that a cloud's stamp carries.
  HeightMap map_at(const ros::Time& stamp) {
    const auto has_it = [&] {
      return !maps_.messages.empty() && maps_.messages.back()->info.header.stamp == stamp;
    };
    if (wait_until(has_it)) return to_height_map(*maps_.messages.back());
    ADD_FAILURE() << "no map with stamp " << stamp;
    HeightMap none(GridGeometry(0, 0, 0.01, 40, 20));
    none.add(layer::elevation);
    none.add(layer::variance);
    return none;
  }

  HeightMap map_after(const sensor_msgs::PointCloud2& cloud) {
    points_.publish(cloud);
    return map_at(cloud.header.stamp);
  }

  static void expect_plane(const HeightMap& map) {
    const HeightMap::Layer& elevation = map.layer(layer::elevation);
    double sum = 0;
    double sum_of_squares = 0;
    for (std::size_t i = 0; i < elevation.size(); ++i) {
      const CellIndex at = map.geometry().cell_at(i);
      const double d =
          static_cast<double>(elevation[i]) - plane(map.geometry().x(at.x), map.geometry().y(at.y));
      sum += d;
      sum_of_squares += d * d;
    }
    const auto n = static_cast<double>(elevation.size());
    EXPECT_LT(std::abs(sum / n), 5 * sigma / 3 / std::sqrt(n));
    EXPECT_NEAR(std::sqrt(sum_of_squares / n), sigma / 3, 0.1 * sigma);  // the mean of nine
  }

  ros::NodeHandle nh_;
  tf2_ros::StaticTransformBroadcaster tf_;
  ros::Publisher points_ = nh_.advertise<sensor_msgs::PointCloud2>("points", 10);
  Listener<grid_map_msgs::GridMap> maps_{nh_, "height_map"};
  Diagnostics diagnostics_{nh_};
};

TEST_F(HeightMapperTest, MapsAPlaneWithinTheNoiseAndKeepsTheStamp) {
  const HeightMap map = map_after(plane_cloud(ros::Time(1700000000, 123456789)));
  EXPECT_EQ(map.geometry().nx(), 40);
  EXPECT_EQ(map.geometry().ny(), 20);
  expect_plane(map);
  for (const float v : map.layer(layer::variance)) EXPECT_NEAR(std::sqrt(v), sigma / 3, 0.2 * sigma);
  EXPECT_EQ(maps_.messages.back()->info.header.frame_id, "map");
  EXPECT_TRUE(diagnostics_.is_well("height_mapper"));

  Listener<grid_map_msgs::GridMap> late(nh_, "height_map");
  EXPECT_TRUE(wait_until([&] { return !late.messages.empty(); })) << "the map is not latched";
}

TEST_F(HeightMapperTest, ABadCloudIsReportedAndTheMapStays) {
  const HeightMap before = map_after(plane_cloud(ros::Time(1700000100)));
  const std::size_t maps = maps_.messages.size();

  auto no_z = plane_cloud(ros::Time(1700000101));
  no_z.fields[2].name = "intensity";
  points_.publish(no_z);
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "there is no field 'z'"));

  auto torn = plane_cloud(ros::Time(1700000102));
  torn.data.resize(torn.data.size() / 2);
  points_.publish(torn);
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "data has"));

  points_.publish(cloud_of({{nan, nan, nan}, {nan, nan, nan}}, "scanner", ros::Time(1700000103)));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "none of 2 points can be used: 2 not finite"));

  points_.publish(cloud_of({}, "scanner", ros::Time(1700000104)));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "none of 0 points"));

  points_.publish(plane_cloud(ros::Time(1700000105), "nowhere"));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "no transform from 'nowhere' to 'map'"));

  points_.publish(plane_cloud(ros::Time(1700000106), ""));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "frame_id is empty"));

  EXPECT_EQ(maps_.messages.size(), maps) << "a bad cloud made a map";
  expect_plane(map_after(plane_cloud(ros::Time(1700000107))));
  EXPECT_TRUE(diagnostics_.is_well("height_mapper"));
}

TEST_F(HeightMapperTest, ABagThatLoopsKeepsTheMapAndGoesOn) {
  tf2_ros::TransformBroadcaster moving;
  const auto send_pose = [&](std::uint32_t second) {
    moving.sendTransform(scanner_pose("moving", ros::Time(second)));
  };
  ASSERT_TRUE(wait_until([&] {  // the first poses may go before the node listens
    send_pose(1700001000);
    send_pose(1700001002);
    points_.publish(plane_cloud(ros::Time(1700001001), "moving"));
    ros::WallDuration(0.05).sleep();
    ros::spinOnce();
    return is_newest(ros::Time(1700001001));
  }));
  const std::size_t known = count_known(map_at(ros::Time(1700001001)).layer(layer::elevation));
  EXPECT_EQ(known, 800U);

  // One cell only, a thousand seconds earlier: the rest of the map must still be there.
  auto one = cloud_of({{0.005F, 0.005F, 0.95F}}, "moving", ros::Time(1700000001));
  points_.publish(one);
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "time jumped back"));
  send_pose(1700000000);
  send_pose(1700000002);
  EXPECT_EQ(count_known(map_at(ros::Time(1700000001)).layer(layer::elevation)), 800U);
}

TEST_F(HeightMapperTest, SavesClearsAndLoads) {
  const TemporaryFolder folder;
  const HeightMap before = map_after(plane_cloud(ros::Time(1700002000)));
  nh_.setParam("height_mapper/map_file", folder.file("map.tif"));
  for (const std::string& file : {std::string(), folder.file("map.bag")}) {
    EXPECT_TRUE(process("save_map", file));
    maps_.messages.clear();
    call("clear_map");
    EXPECT_EQ(count_known(map_at(ros::Time(1700002000)).layer(layer::elevation)), 0U);
    maps_.messages.clear();
    EXPECT_TRUE(process("load_map", file));
    EXPECT_EQ(map_at(ros::Time(1700002000)).layer(layer::elevation), before.layer(layer::elevation));
  }
  EXPECT_TRUE(std::filesystem::exists(folder.file("map.tif"))) << "~map_file is the file of requests without";

  EXPECT_FALSE(process("load_map", folder.file("missing.tif")));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", folder.file("missing.tif")));
  EXPECT_FALSE(process("save_map", "/nowhere/map.tif"));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "/nowhere"));
  EXPECT_FALSE(process("load_map", folder.write("text.bag", "no bag")));
  EXPECT_EQ(count_known(map_after(plane_cloud(ros::Time(1700002001))).layer(layer::elevation)), 800U);
}

TEST_F(HeightMapperTest, GivesAPartOfTheMap) {
  const HeightMap whole = map_after(plane_cloud(ros::Time(1700003000)));
  grid_map_msgs::GetGridMap request;
  request.request.position_x = 0.1;
  request.request.position_y = 0.1;
  request.request.length_x = 0.04;
  request.request.length_y = 0.02;
  request.request.layers = {layer::elevation};
  ASSERT_TRUE(ros::service::call("get_submap", request));
  const HeightMap part = to_height_map(request.response.map);
  EXPECT_EQ(request.response.map.info.header.stamp, ros::Time(1700003000));
  EXPECT_EQ(part.names(), std::vector<std::string>{layer::elevation});
  ASSERT_EQ(part.geometry().nx(), 4);
  ASSERT_EQ(part.geometry().ny(), 2);
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x)
      EXPECT_EQ(part.layer(layer::elevation)[part.geometry().index(x, y)],
                whole.layer(layer::elevation)[whole.geometry().index(8 + x, 9 + y)]);

  request.request.position_x = 5;
  EXPECT_FALSE(ros::service::call("get_submap", request));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "has no cell of the map"));
  request.request.position_x = 0.1;
  request.request.layers = {"age"};
  EXPECT_FALSE(ros::service::call("get_submap", request));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "'age'"));
  request.request.layers.clear();
  request.request.frame_id = "nowhere";
  EXPECT_FALSE(ros::service::call("get_submap", request));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "nowhere"));
  request.request.frame_id = "scanner";  // at (0.2, 0.1), y turned over
  request.request.position_x = -0.1;
  request.request.position_y = 0;
  ASSERT_TRUE(ros::service::call("get_submap", request));
  EXPECT_EQ(to_height_map(request.response.map).geometry(), part.geometry());
}

TEST_F(HeightMapperTest, ReplacesMaskedCellsAndHoldsUpdates) {
  map_after(plane_cloud(ros::Time(1700004000)));
  maps_.messages.clear();
  HeightMap patch(GridGeometry(0.1, 0.1, 0.01, 10, 5));
  patch.add(layer::elevation, 0.5F);
  patch.add("mask")[0] = 1;
  grid_map_msgs::SetGridMap request;
  std_msgs::Header header;
  header.frame_id = "map";
  request.request.map = to_message(patch, header);
  ASSERT_TRUE(ros::service::call("masked_replace", request));
  const HeightMap map = map_at(ros::Time(1700004000));
  EXPECT_NEAR(map.layer(layer::elevation)[map.geometry().index(10, 10)], 0.5, 1e-5);
  EXPECT_LT(map.layer(layer::elevation)[map.geometry().index(11, 10)], 0.1);
  request.request.map.info.resolution = -1;
  EXPECT_FALSE(ros::service::call("masked_replace", request));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "info.resolution is -1"));

  call("disable_updates");
  const std::size_t maps = maps_.messages.size();
  points_.publish(plane_cloud(ros::Time(1700004001)));
  EXPECT_TRUE(diagnostics_.is_well("height_mapper"));
  ros::WallDuration(0.2).sleep();
  ros::spinOnce();
  EXPECT_EQ(maps_.messages.size(), maps);
  call("enable_updates");
  map_after(plane_cloud(ros::Time(1700004002)));
}

TEST_F(HeightMapperTest, TakesPatchesWithTheirUncertainty) {
  map_after(plane_cloud(ros::Time(1700004500)));
  ros::Publisher patches = nh_.advertise<grid_map_msgs::GridMap>("patches", 10);
  ASSERT_TRUE(wait_until([&] { return patches.getNumSubscribers() > 0; }));
  HeightMap patch(GridGeometry(0.1, 0.1, 0.01, 10, 5));
  patch.add(layer::elevation)[0] = 0.5F;
  std_msgs::Header header;
  header.frame_id = "map";
  patches.publish(to_message(patch, header));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "/patches: the patch has no layer 'variance'"));
  patch.add(layer::variance)[0] = 0;
  patches.publish(to_message(patch, header));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "variance of cell (0, 0) is 0, must be positive"));
  patch.layer(layer::variance)[0] = 4e-4F;
  header.frame_id = "odom";
  patches.publish(to_message(patch, header));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "the map's frame is 'odom', must be 'map'"));

  maps_.messages.clear();
  header.frame_id = "map";
  patches.publish(to_message(patch, header));
  ASSERT_TRUE(wait_until([&] { return !maps_.messages.empty(); }));
  const HeightMap map = to_height_map(*maps_.messages.back());
  const std::size_t there = map.geometry().index(10, 10), beside = map.geometry().index(11, 10);
  EXPECT_NEAR(map.layer(layer::elevation)[there], 0.5, 1e-5);
  EXPECT_NEAR(map.layer(layer::variance)[there], 4e-4, 1e-8);
  EXPECT_LT(map.layer(layer::elevation)[beside], 0.1) << "cells that the patch does not know stay";
  EXPECT_LT(map.layer(layer::variance)[beside], 1e-5);
  EXPECT_TRUE(diagnostics_.is_well("height_mapper"));
}

TEST_F(HeightMapperTest, ATransformThatContradictsTheMapIsTold) {
  for (std::uint32_t i = 0; i < 3; ++i) map_after(plane_cloud(ros::Time(1700005000 + i)));
  geometry_msgs::TransformStamped moved = scanner_pose("moved", ros::Time::now());
  moved.transform.translation.z += 0.05;
  tf_.sendTransform(moved);
  points_.publish(plane_cloud(ros::Time(1700005003), "moved"));
  EXPECT_TRUE(diagnostics_.warns("height_mapper", "most contradict the map"));
  const HeightMap map = map_after(plane_cloud(ros::Time(1700005004)));
  EXPECT_NEAR(map.layer(layer::elevation)[map.geometry().index(20, 10)], plane(0.205, 0.105), sigma);
}

/// Two scanners of which the second stamps its clouds half a second late while it moves.
TEST_F(HeightMapperTest, HearsSeveralSensorsEachWithItsLatency) {
  nh_.setParam("rig/height_mapper/sensors/front/topic", "front/cloud");
  nh_.setParam("rig/height_mapper/sensors/rail/latency", 0.5);
  const RunningProgram rig("height_mapper", {"__ns:=rig", "_cell_size:=0.01", "_length_x:=0.4",
                                             "_length_y:=0.2", "_diagnostic_period:=0.1"});
  ros::Publisher front = nh_.advertise<sensor_msgs::PointCloud2>("rig/front/cloud", 10);
  ros::Publisher rail = nh_.advertise<sensor_msgs::PointCloud2>("rig/rail/points", 10);
  Listener<grid_map_msgs::GridMap> maps(nh_, "rig/height_map");
  ASSERT_TRUE(wait_until(
      [&] { return front.getNumSubscribers() > 0 && rail.getNumSubscribers() > 0 && maps.connected(); }));
  EXPECT_TRUE(diagnostics_.warns("rig", "no cloud has arrived"));
  const auto map_of = [&](const ros::Time& stamp) {
    EXPECT_TRUE(wait_until(
        [&] { return !maps.messages.empty() && maps.messages.back()->info.header.stamp == stamp; }));
    return to_height_map(*maps.messages.back());
  };
  // The rail's scanner is at its place at t = 10 and 10 cm higher at t = 10.5.
  tf2_ros::TransformBroadcaster moving;
  const ros::Time t(1700006010);
  const auto send_poses = [&] {
    auto low = scanner_pose("on_rail", t - ros::Duration(1));
    moving.sendTransform(low);
    low.header.stamp = t;
    moving.sendTransform(low);
    auto high = scanner_pose("on_rail", t + ros::Duration(0.5));
    high.transform.translation.z += 0.1;
    moving.sendTransform(high);
    high.header.stamp += ros::Duration(1);
    moving.sendTransform(high);
  };
  front.publish(plane_cloud(t - ros::Duration(1)));
  expect_plane(map_of(t - ros::Duration(1)));
  ASSERT_TRUE(wait_until([&] {  // the first poses may go before the node listens
    send_poses();
    rail.publish(plane_cloud(t + ros::Duration(0.5), "on_rail"));
    ros::WallDuration(0.05).sleep();
    ros::spinOnce();
    return maps.messages.back()->info.header.stamp == t;
  }));
  const HeightMap map = map_of(t);
  const std::size_t i = map.geometry().index(20, 10);
  EXPECT_NEAR(map.layer(layer::elevation)[i], plane(0.205, 0.105), 5 * sigma / 3);
  EXPECT_LT(map.layer(layer::variance)[i], 0.7 * sigma * sigma / 9) << "both sensors count";
}

/// A scanner whose tf says that it stands 4 mm too high and leans by half a degree.
TEST_F(HeightMapperTest, RefinesCloudsAgainstTheMapWhenAsked) {
  const RunningProgram node("height_mapper",
                            {"__ns:=refined", "points:=/points", "_cell_size:=0.01", "_length_x:=0.4",
                             "_length_y:=0.2", "_registration:=icp", "_diagnostic_period:=0.1"});
  Listener<grid_map_msgs::GridMap> maps(nh_, "refined/height_map");
  ASSERT_TRUE(wait_until([&] { return maps.connected() && points_.getNumSubscribers() > 1; }));
  const auto map_of = [&](const sensor_msgs::PointCloud2& cloud) {
    points_.publish(cloud);
    EXPECT_TRUE(wait_until([&] {
      return !maps.messages.empty() && maps.messages.back()->info.header.stamp == cloud.header.stamp;
    }));
    return to_height_map(*maps.messages.back());
  };
  expect_plane(map_of(plane_cloud(ros::Time(1700009000))));
  geometry_msgs::TransformStamped off = scanner_pose("off", ros::Time::now());
  off.transform.translation.z += 0.004;
  off.transform.rotation.y = std::sin(0.25 * M_PI / 180);
  off.transform.rotation.x = std::cos(0.25 * M_PI / 180);
  tf_.sendTransform(off);
  for (std::uint32_t i = 1; i < 5; ++i) map_of(plane_cloud(ros::Time(1700009000 + i), "off"));
  const HeightMap map = map_of(plane_cloud(ros::Time(1700009005), "off"));
  for (const CellIndex at : {CellIndex{2, 2}, CellIndex{37, 2}, CellIndex{20, 10}, CellIndex{37, 17}}) {
    const double truth = plane(map.geometry().x(at.x), map.geometry().y(at.y));
    EXPECT_NEAR(map.layer(layer::elevation)[map.geometry().index(at)], truth, sigma) << at.x << ' ' << at.y;
  }

  off.transform.translation.z += 0.1;
  tf_.sendTransform(off);
  ros::WallDuration(0.3).sleep();
  points_.publish(plane_cloud(ros::Time(1700009006), "off"));
  EXPECT_TRUE(diagnostics_.warns("refined", "refused, the cloud is used as tf says"));
}

TEST_F(HeightMapperTest, LaysTheMapAlongTheBedWhenAsked) {
  const RunningProgram node("height_mapper",
                            {"__ns:=level", "points:=/points", "_cell_size:=0.01", "_level:=true"});
  Listener<grid_map_msgs::GridMap> maps(nh_, "level/height_map");
  Listener<tf2_msgs::TFMessage> frames(nh_, "/tf_static");
  ASSERT_TRUE(wait_until([&] { return maps.connected() && points_.getNumSubscribers() > 1; }));
  points_.publish(plane_cloud(ros::Time(1700010000)));
  ASSERT_TRUE(wait_until([&] { return !maps.messages.empty(); }));
  EXPECT_EQ(maps.messages.back()->info.header.frame_id, "bed");
  const HeightMap map = to_height_map(*maps.messages.back());
  double sum_of_squares = 0;
  for (const float z : map.layer(layer::elevation))
    if (std::isfinite(z)) sum_of_squares += static_cast<double>(z) * static_cast<double>(z);
  const auto known = static_cast<double>(count_known(map.layer(layer::elevation)));
  EXPECT_GT(known, 750);
  EXPECT_LT(std::sqrt(sum_of_squares / known), 0.6 * sigma) << "the bed is level in its own frame";
  const auto bed = [&]() -> const geometry_msgs::TransformStamped* {
    for (const auto& message : frames.messages)
      for (const auto& transform : message->transforms)
        if (transform.child_frame_id == "bed" && transform.header.frame_id == "map") return &transform;
    return nullptr;
  };
  ASSERT_TRUE(wait_until([&] { return bed() != nullptr; }));
  const auto& q = bed()->transform.rotation;
  const Eigen::Vector3d normal = Eigen::Quaterniond(q.w, q.x, q.y, q.z) * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d truth = Eigen::Vector3d(-0.1, 0.05, 1).normalized();
  EXPECT_LT(std::acos(normal.dot(truth)), 1e-3);
}

TEST_F(HeightMapperTest, AKilledNodeGoesOnWithItsMap) {
  const TemporaryFolder folder;
  const std::vector<std::string> arguments{"__ns:=saver",
                                           "points:=/points",
                                           "_cell_size:=0.01",
                                           "_length_x:=0.4",
                                           "_length_y:=0.2",
                                           "_autosave_period:=0.2",
                                           "_autosave_file:=" + folder.file("auto.bag")};
  Listener<grid_map_msgs::GridMap> maps(nh_, "saver/height_map");
  HeightMap before;
  {
    RunningProgram saver("height_mapper", arguments);
    ASSERT_TRUE(wait_until([&] { return maps.connected(); }));
    ASSERT_TRUE(wait_until([&] {
      points_.publish(plane_cloud(ros::Time(1700007000)));
      ros::WallDuration(0.05).sleep();
      ros::spinOnce();
      return !maps.messages.empty();
    }));
    ros::WallDuration(0.3).sleep();  // what was on its way
    ros::spinOnce();
    before = to_height_map(*maps.messages.back());
    ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(folder.file("auto.bag")); }));
    ros::WallDuration(0.6).sleep();
    saver.kill_now();
  }
  maps.messages.clear();
  const RunningProgram again("height_mapper", arguments);
  ASSERT_TRUE(wait_until([&] { return !maps.messages.empty(); })) << "a node started again has no map";
  EXPECT_EQ(to_height_map(*maps.messages.back()).layer(layer::elevation), before.layer(layer::elevation));
  EXPECT_EQ(maps.messages.back()->info.header.stamp, ros::Time(1700007000));
}

TEST_F(HeightMapperTest, PublishesOnlyWhatChanged) {
  const RunningProgram node("height_mapper", {"__ns:=part", "points:=/points", "_cell_size:=0.01",
                                              "_length_x:=1.28", "_length_y:=0.64", "_incremental:=true"});
  Listener<grid_map_msgs::GridMap> whole(nh_, "part/height_map");
  Listener<grid_map_msgs::GridMap> updates(nh_, "part/height_map_updates");
  HeightMap map;
  const MapReceiver receiver(
      nh_, "part/height_map",
      [&](const HeightMap& now, const std_msgs::Header&, const TileMask&) { map = now; },
      [](const std::string& reason) { ADD_FAILURE() << reason; });
  ASSERT_TRUE(wait_until([&] { return whole.connected() && updates.connected(); }));
  ASSERT_TRUE(wait_until([&] {
    points_.publish(plane_cloud(ros::Time(1700008000)));
    ros::WallDuration(0.05).sleep();
    ros::spinOnce();
    return !updates.messages.empty() && !whole.messages.empty();
  }));
  const std::size_t wholes = whole.messages.size();
  updates.messages.clear();
  // One cell, 6 cm to the east and 1 cm to the south of the map's middle tiles' corner.
  auto one = cloud_of({{0.305F, 0.005F, 0.95F}}, "scanner", ros::Time(1700008001));
  points_.publish(one);
  ASSERT_TRUE(wait_until([&] { return !updates.messages.empty(); }));
  const HeightMap part = to_height_map(*updates.messages.back());
  EXPECT_EQ(part.geometry().nx(), 32) << "the one tile that has the cell";
  EXPECT_EQ(part.geometry().ny(), 32);
  EXPECT_EQ(whole.messages.size(), wholes) << "the whole map goes to new listeners only";

  Listener<grid_map_msgs::GridMap> late(nh_, "part/height_map");
  ASSERT_TRUE(wait_until([&] { return !late.messages.empty(); }));
  const HeightMap now = to_height_map(*late.messages.back());
  EXPECT_EQ(now.geometry().nx(), 128);
  ASSERT_TRUE(wait_until([&] { return map.names().size() == now.names().size(); }));
  EXPECT_EQ(count_known(map.layer(layer::elevation)), count_known(now.layer(layer::elevation)));
}

TEST(Programs, RefuseABadParameterInOneLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"height_mapper _cell_size:=-1",
       "height_mapper: /bad/cell_size: -1 is not allowed, must be a number above 0 [m]\n"},
      {"height_mapper _cell_size:=big",
       "height_mapper: /bad/cell_size: 'big' is not allowed, must be a number above 0 [m]\n"},
      {"wind_estimator _max_gap:=0",
       "wind_estimator: /bad/max_gap: 0 is not allowed, must be a number above 0 [s]\n"},
      {"forecaster _porosity:=2",
       "forecaster: /bad/porosity: 2 is not allowed, must be a number from 0 to 0.95\n"},
      {"comparator _max_maps:=1",
       "comparator: /bad/max_maps: 1 is not allowed, must be a whole number from 2 to 1000\n"},
      {"surface_display _palette:=grey",
       "surface_display: /bad/palette: 'grey' is not allowed, must be one of sand, diverging, viridis\n"},
  };
  for (const auto& [command, line] : cases) {
    const Outcome outcome = run_program(command + " __name:=bad");
    EXPECT_EQ(outcome.code, 1) << command;
    EXPECT_EQ(outcome.err, line);
    ros::param::del("/bad");
  }
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "height_mapper_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
