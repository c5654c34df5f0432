/// height_mapper on real scans that are not ours: its cells against the points that fell into them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "../shared_data.hpp"
#include "ros_test.hpp"
#include <geometry_msgs/TransformStamped.h>
#include <grid_map_msgs/GridMap.h>
#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <sensor_msgs/PointCloud2.h>
#include <sensor_msgs/point_cloud2_iterator.h>
#include <std_srvs/Empty.h>
#include <tf2_msgs/TFMessage.h>
#include <tf2_ros/static_transform_broadcaster.h>
#include <unistd.h>

#include "aeolian_core/surface/cloud_file.hpp"
#include "aeolian_core/surface/median.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

/// The points in true coordinates as doubles.
sensor_msgs::PointCloud2 to_message(const PointCloud& cloud, const std::string& frame,
                                    const ros::Time& stamp) {
  sensor_msgs::PointCloud2 message;
  message.header.frame_id = frame;
  message.header.stamp = stamp;
  sensor_msgs::PointCloud2Modifier modifier(message);
  using sensor_msgs::PointField;
  modifier.setPointCloud2Fields(3, "x", 1, PointField::FLOAT64, "y", 1, PointField::FLOAT64, "z", 1,
                                PointField::FLOAT64);
  modifier.resize(cloud.size());
  sensor_msgs::PointCloud2Iterator<double> xyz(message, "x");
  for (std::size_t i = 0; i < cloud.size(); ++i, ++xyz) {
    xyz[0] = cloud.origin_x + static_cast<double>(cloud.x[i]);
    xyz[1] = cloud.origin_y + static_cast<double>(cloud.y[i]);
    xyz[2] = cloud.origin_z + static_cast<double>(cloud.z[i]);
  }
  return message;
}

/// What a map has to do with the points from which it was made; heights are `base + up * z`.
struct Agreement {
  std::size_t points_outside = 0;
  std::size_t cells_with_points = 0;
  std::size_t known_cells = 0;
  double median_of_differences = 0;  ///< between a cell and the median of its points [m]
};
Agreement compare_with_points(const HeightMap& map, const PointCloud& cloud, double base, double up) {
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  std::vector<std::vector<double>> points(elevation.size());
  Agreement result;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    if (!std::isfinite(cloud.x[i])) continue;
    const double y = cloud.origin_y + static_cast<double>(cloud.y[i]);
    const auto cell = map.geometry().find(cloud.origin_x + static_cast<double>(cloud.x[i]), up * y);
    if (cell)
      points[map.geometry().index(*cell)].push_back(base +
                                                    up * (cloud.origin_z + static_cast<double>(cloud.z[i])));
    else
      ++result.points_outside;
  }
  std::vector<double> differences;
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    result.known_cells += std::isfinite(elevation[i]) ? 1 : 0;
    if (points[i].empty()) continue;
    ++result.cells_with_points;
    if (std::isfinite(elevation[i]))
      differences.push_back(std::abs(static_cast<double>(elevation[i]) - median(points[i])));
  }
  result.median_of_differences = median(differences);
  return result;
}

class RealScans : public ::testing::Test {
 protected:
  PointCloud read(const std::string& name) { return read_cloud((shared_data() / name).string()); }

  HeightMap map_of(const std::string& ns, const sensor_msgs::PointCloud2& cloud) {
    ros::Publisher points = nh_.advertise<sensor_msgs::PointCloud2>(ns + "/points", 1);
    Listener<grid_map_msgs::GridMap> maps(nh_, ns + "/height_map");
    EXPECT_TRUE(wait_until([&] { return points.getNumSubscribers() > 0 && maps.connected(); }));
    points.publish(cloud);
    const auto arrived = [&] {
      return !maps.messages.empty() && maps.messages.back()->info.header.stamp == cloud.header.stamp;
    };
    if (wait_until(arrived, 30)) return to_height_map(*maps.messages.back());
    throw std::runtime_error("no map came from " + ns);
  }

  ros::NodeHandle nh_;
};

TEST_F(RealScans, AirborneLidarInUtmCoordinates) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no " << shared_data();
  const PointCloud cloud = read("lidar-terrain/samp53-utm-ground.pcd");
  const HeightMap map = map_of("lidar", to_message(cloud, "map", ros::Time(1000)));
  EXPECT_GT(map.geometry().origin_y(), 5e6);
  const Agreement agreement = compare_with_points(map, cloud, 0, 1);
  EXPECT_EQ(agreement.points_outside, 0U);
  EXPECT_EQ(agreement.known_cells, agreement.cells_with_points);
  EXPECT_GT(agreement.known_cells, 10000U);
  EXPECT_LT(agreement.median_of_differences, 0.02) << "the scanner is good to some centimetres";
}

/// What a user does with a file: make_bag, then the bag into the node.
TEST_F(RealScans, AirborneLidarThroughMakeBag) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no " << shared_data();
  const std::string file = std::filesystem::absolute(shared_data() / "lidar-terrain/samp53-utm.pcd").string();
  const auto folder = std::filesystem::temp_directory_path() / ("real_scans_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "manifest.yaml") << "clouds: [{file: " << file << ", stamp: 1000.5}]\n";
  const std::string bag_path = (folder / "scan.bag").string();
  const std::string command =
      AEOLIAN_BIN "/make_bag " + (folder / "manifest.yaml").string() + " " + bag_path + " > /dev/null";
  ASSERT_EQ(std::system(command.c_str()), 0);

  tf2_ros::StaticTransformBroadcaster tf;
  sensor_msgs::PointCloud2::ConstPtr scan;
  rosbag::Bag bag(bag_path);
  for (const rosbag::MessageInstance& message : rosbag::View(bag)) {
    if (const auto frames = message.instantiate<tf2_msgs::TFMessage>()) tf.sendTransform(frames->transforms);
    if (const auto points = message.instantiate<sensor_msgs::PointCloud2>()) scan = points;
  }
  bag.close();
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(scan);
  const HeightMap map = map_of("bag", *scan);
  const Agreement agreement = compare_with_points(map, read_cloud(file), 0, 1);
  EXPECT_EQ(agreement.points_outside, 0U);
  EXPECT_EQ(agreement.known_cells, agreement.cells_with_points);
  EXPECT_GT(agreement.known_cells, 10000U);
  EXPECT_LT(agreement.median_of_differences, 0.02);
}

TEST_F(RealScans, DepthCamera) {
  if (!std::filesystem::exists(shared_data())) GTEST_SKIP() << "no " << shared_data();
  constexpr double mast = 3;  // the camera looks down from here: y and z of its optical frame are turned over
  geometry_msgs::TransformStamped pose;
  pose.header.frame_id = "map";
  pose.child_frame_id = "camera";
  pose.transform.translation.z = mast;
  pose.transform.rotation.x = 1;
  tf2_ros::StaticTransformBroadcaster tf;
  tf.sendTransform(pose);
  for (std::uint32_t i = 1; i <= 5; ++i) {
    const PointCloud cloud = read("depth-camera/capture000" + std::to_string(i) + ".pcd");
    const HeightMap map = map_of("camera", to_message(cloud, "camera", ros::Time(1000 + i)));
    const Agreement agreement = compare_with_points(map, cloud, mast, -1);
    EXPECT_EQ(agreement.known_cells, agreement.cells_with_points) << i;
    EXPECT_GT(agreement.known_cells, 10000U) << i;
    EXPECT_LT(agreement.median_of_differences, 0.002) << i;
    std_srvs::Empty clear;
    EXPECT_TRUE(ros::service::call("camera/clear_map", clear));
  }
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  ros::init(argc, argv, "real_scans_rostest");
  const ros::NodeHandle keeps_ros_alive;
  return RUN_ALL_TESTS();
}
