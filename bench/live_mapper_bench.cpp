// What height_mapper costs while it runs: the program itself under a master, clouds of 640 x 480 points at 10
// Hz over TCP into 1000 x 1000 cells of 2 mm. The table gives its processor time in per cent of one core, and
// what it sends.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "child_process.hpp"
#include "own_master.hpp"
#include "scanned_ripples.hpp"
#include <fmt/format.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"

namespace {

using namespace aeolian;

constexpr double rate = 10;
constexpr int warm_up = 300;  // a still bed is known to be still after some 20 s
constexpr int measured = 150;

struct Scene {
  std::string name;
  int columns, rows;  ///< of the image; 0: no clouds
  double width;       ///< that it sees, of the map's 2 m [m]
  double ripples;     ///< height of ripples of 10 cm that migrate at 3 cm/min [m]
  bool incremental;
  bool heard;
};

sensor_msgs::PointCloud2 cloud_of(const Scene& scene, double time, std::uint64_t number) {
  const bench::ScannedRipples ripples{scene.columns, scene.rows, scene.width, scene.width, scene.ripples};
  sensor_msgs::PointCloud2 message =
      to_message(ripples.at(time, number), static_cast<std::size_t>(scene.columns));
  message.header.frame_id = "camera";
  return message;
}

void measure(const Scene& scene, ros::NodeHandle& node) {
  const ChildProcess mapper(
      {std::string(AEOLIAN_BIN) + "/height_mapper", "_cell_size:=0.002", "_min_x:=-1", "_min_y:=-1",
       "_length_x:=2", "_length_y:=2", "_range_sigma:=" + std::to_string(bench::ScannedRipples::noise),
       fmt::format("_incremental:={}", scene.incremental)},
      SIGINT, ChildProcess::Output::dropped);
  ros::Publisher points = node.advertise<sensor_msgs::PointCloud2>("points", 4);
  while (ros::ok() && points.getNumSubscribers() == 0) ros::WallDuration(0.1).sleep();

  std::size_t messages = 0;
  double bytes = 0;
  const boost::function<void(const grid_map_msgs::GridMap::ConstPtr&)> count =
      [&](const grid_map_msgs::GridMap::ConstPtr& map) {
        ++messages;
        for (const auto& layer : map->data) bytes += 4.0 * static_cast<double>(layer.data.size());
      };
  std::vector<ros::Subscriber> listeners;
  if (scene.heard)
    for (const char* topic : {"height_map", "height_map_updates"})
      listeners.push_back(node.subscribe<grid_map_msgs::GridMap>(topic, 1000, count));

  std::vector<sensor_msgs::PointCloud2> clouds;
  const int variants = scene.ripples > 0 ? warm_up + measured : 20;
  if (scene.columns > 0 && scene.ripples == 0)
    for (int i = 0; i < variants; ++i) clouds.push_back(cloud_of(scene, 0, static_cast<std::uint64_t>(i)));
  double before = 0;
  ros::WallRate tick(rate);
  for (int i = 0; i < warm_up + measured && ros::ok(); ++i) {
    if (i == warm_up) {
      before = mapper.processor_seconds();
      messages = 0;
      bytes = 0;
    }
    if (scene.columns > 0) {
      sensor_msgs::PointCloud2 moving;
      if (scene.ripples > 0) moving = cloud_of(scene, i / rate, static_cast<std::uint64_t>(i));
      sensor_msgs::PointCloud2& cloud =
          scene.ripples > 0 ? moving : clouds[static_cast<std::size_t>(i) % clouds.size()];
      cloud.header.stamp = ros::Time(1700000000) + ros::Duration(i / rate);
      points.publish(cloud);
    }
    ros::spinOnce();
    tick.sleep();
  }
  ros::spinOnce();
  const double seconds = measured / rate;
  std::printf("| %-44s | %7d | %5.1f | %6.1f | %6.1f |\n", scene.name.c_str(), scene.columns * scene.rows,
              100 * (mapper.processor_seconds() - before) / seconds, static_cast<double>(messages) / seconds,
              1e-6 * bytes / seconds);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::OwnMaster master;
  ros::init(argc, argv, "live_mapper_bench", ros::init_options::NoSigintHandler);
  while (!ros::master::check()) ros::WallDuration(0.1).sleep();
  ros::NodeHandle node;
  tf2_ros::StaticTransformBroadcaster broadcaster;
  broadcaster.sendTransform(bench::camera_pose(ros::Time::now(), 0, 0));

  std::printf(
      "| scene, 1000 x 1000 cells, 10 Hz | points | %% of a core | maps/s | MB/s |\n|---|---|---|---|---|\n");
  const std::vector<Scene> scenes{
      {"no clouds", 0, 0, 2, 0, true, true},
      {"still, a lidar's", 200, 150, 2, 0, true, true},
      {"still, over the map", 640, 480, 2, 0, true, true},
      {"still, over a sixth of the map", 640, 480, 0.8, 0, true, true},
      {"still, over the map, whole maps", 640, 480, 2, 0, false, true},
      {"still, over the map, nobody listens", 640, 480, 2, 0, true, false},
      {"ripples migrate, over the map", 640, 480, 2, 0.005, true, true},
  };
  for (const Scene& scene : scenes) measure(scene, node);
  return 0;
}
