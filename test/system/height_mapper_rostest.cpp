/// height_mapper as a program under a master: clouds and tf in, maps and diagnostics out.
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <limits>

#include "ros_test.hpp"
#include <geometry_msgs/TransformStamped.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_srvs/Trigger.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <tf2_ros/transform_broadcaster.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

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

  std_srvs::Trigger::Response call(const std::string& service) {
    std_srvs::Trigger trigger;
    EXPECT_TRUE(ros::service::waitForService(service, 10000));
    EXPECT_TRUE(ros::service::call(service, trigger));
    return trigger.response;
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
  const std::string file = (std::filesystem::temp_directory_path() / "height_mapper_rostest.tif").string();
  nh_.setParam("height_mapper/map_file", file);
  const HeightMap before = map_after(plane_cloud(ros::Time(1700002000)));
  const auto saved = call("save_map");
  EXPECT_TRUE(saved.success) << saved.message;
  EXPECT_NE(saved.message.find(file), std::string::npos);

  maps_.messages.clear();
  EXPECT_TRUE(call("clear_map").success);
  EXPECT_EQ(count_known(map_at(ros::Time(1700002000)).layer(layer::elevation)), 0U);

  maps_.messages.clear();
  EXPECT_TRUE(call("load_map").success);
  EXPECT_EQ(map_at(ros::Time(1700002000)).layer(layer::elevation), before.layer(layer::elevation));
  std::filesystem::remove(file);

  const auto missing = call("load_map");
  EXPECT_FALSE(missing.success);
  EXPECT_NE(missing.message.find(file), std::string::npos) << missing.message;
  nh_.setParam("height_mapper/map_file", "/nowhere/map.tif");
  const auto unwritten = call("save_map");
  EXPECT_FALSE(unwritten.success);
  EXPECT_NE(unwritten.message.find("/nowhere"), std::string::npos) << unwritten.message;
}

/// What a program prints on stderr, and its exit code.
std::pair<std::string, int> run(const std::string& command) {
  FILE* pipe = popen((command + " 2>&1 >/dev/null").c_str(), "r");
  std::string text;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) text += static_cast<char>(c);
  const int status = pclose(pipe);
  return {text, WIFEXITED(status) ? WEXITSTATUS(status) : -1};
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
       "surface_display: /bad/palette: 'grey' is not allowed, must be one of sand, diverging\n"},
  };
  for (const auto& [command, line] : cases) {
    const auto [text, code] = run(std::string(AEOLIAN_BIN) + "/" + command + " __name:=bad");
    EXPECT_EQ(code, 1) << command;
    EXPECT_EQ(text, line);
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
