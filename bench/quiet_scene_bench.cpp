// What a scene costs the nodes downstream of the map when little or nothing of it changes: surface_display,
// whose mesh and cloud somebody looks at, forecaster and comparator as processes of their own, a map of
// 1000 x 1000 cells with 4 layers, 10 messages a second. The share of one core that each takes, by the
// kernel's count. The map's time goes on only when something is sent; then the forecaster makes a forecast
// every ten seconds and the comparator scores those that fall due.
//
//     ./twin bench quiet_scene

#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "child_process.hpp"
#include "own_master.hpp"
#include <fmt/format.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <visualization_msgs/MarkerArray.h>

#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/surface/submap.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

constexpr double rate = 10;  // [Hz]
constexpr int messages = 150;
const GridGeometry grid(0, 0, 0.002, 1000, 1000);

class Scene {
 public:
  Scene() : map_(grid) {
    RandomStream random(1, 0);
    HeightMap::Layer& elevation = map_.add(layer::elevation);
    for (std::size_t i = 0; i < elevation.size(); ++i)
      elevation[i] =
          static_cast<float>(0.003 * std::sin(grid.x(grid.cell_at(i).x) / 0.02) + 0.0001 * random.normal());
    map_.add(layer::variance, 1e-6F);
    map_.add("rate", 0);
    map_.add("rate_variance", 1e-12F);
  }

  void send_whole() { whole_.publish(message(map_)); }
  void send_tile() { updates_.publish(message(submap(map_, {0, 32, 0, 32}))); }
  /// A rectangle of tiles whose heights move by a millimetre and back.
  void send_changed(int tiles_x, int tiles_y) {
    const CellRange range{320, 320 + 32 * tiles_x, 320, 320 + 32 * tiles_y};
    HeightMap part = submap(map_, range);
    if (count_++ % 2 == 0)
      for (float& z : part.layer(layer::elevation)) z += 0.001F;
    updates_.publish(message(part));
  }
  /// Too weak to move anything.
  void send_wind() {
    WindField field;
    field.friction_velocity = 0.1;
    wind_.publish(to_message(field, grid, header()));
  }
  bool connected() const {
    return whole_.getNumSubscribers() == 3 && updates_.getNumSubscribers() == 3 &&
           wind_.getNumSubscribers() == 2 && mesh_.getNumPublishers() == 1 && cloud_.getNumPublishers() == 1;
  }
  int pictures = 0;

 private:
  static std_msgs::Header header() {
    std_msgs::Header result;
    result.frame_id = "map";
    result.stamp = ros::Time::now();
    return result;
  }
  static grid_map_msgs::GridMap message(const HeightMap& map) { return to_message(map, header()); }

  HeightMap map_;
  int count_ = 0;
  ros::NodeHandle nh_;
  ros::Publisher whole_ = nh_.advertise<grid_map_msgs::GridMap>("height_map", 1);
  ros::Publisher updates_ = nh_.advertise<grid_map_msgs::GridMap>("height_map_updates", 100);
  ros::Publisher wind_ = nh_.advertise<grid_map_msgs::GridMap>("wind_field", 10);
  ros::Subscriber mesh_ = nh_.subscribe<visualization_msgs::MarkerArray>(
      "mesh", 1,
      boost::function<void(const visualization_msgs::MarkerArray::ConstPtr&)>(
          [this](const visualization_msgs::MarkerArray::ConstPtr&) { ++pictures; }));
  ros::Subscriber cloud_ = nh_.subscribe<sensor_msgs::PointCloud2>(
      "cloud", 1,
      boost::function<void(const sensor_msgs::PointCloud2::ConstPtr&)>(
          [](const sensor_msgs::PointCloud2::ConstPtr&) {}));
};

void spin_for(double seconds) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::WallTime::now() < end) {
    ros::spinOnce();
    ros::WallDuration(0.002).sleep();
  }
}

int run(int argc, char** argv) {
  const bench::OwnMaster master;
  ros::init(argc, argv, "quiet_scene_bench", ros::init_options::NoSigintHandler);
  while (!ros::master::check()) ros::WallDuration(0.1).sleep();

  const std::string here = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  const ChildProcess display(
      {here + "/surface_display", "map:=height_map", "map_updates:=height_map_updates", "_title:=Measured"});
  const ChildProcess forecaster({here + "/forecaster", "_period:=10", "_max_gap:=30"});
  const ChildProcess comparator({here + "/comparator"});
  const std::array<const ChildProcess*, 3> nodes{&display, &forecaster, &comparator};

  Scene scene;
  while (!scene.connected()) spin_for(0.1);
  scene.send_wind();
  scene.send_whole();
  spin_for(5);

  struct Case {
    std::string name;
    std::function<void()> send;
  };
  const std::vector<Case> cases{
      {"nothing is sent", [] {}},
      {"one tile, unchanged", [&] { scene.send_tile(); }},
      {"one tile, changed", [&] { scene.send_changed(1, 1); }},
      {"100 tiles, changed", [&] { scene.send_changed(10, 10); }},
      {"whole maps, unchanged", [&] { scene.send_whole(); }},
  };
  fmt::print("{:<24}{:>16}{:>13}{:>13}{:>12}   (% of one core; meshes in {:.0f} s)\n", "at 10 Hz",
             "surface_display", "forecaster", "comparator", "meshes", messages / rate);
  for (const Case& what : cases) {
    std::vector<double> before;
    for (const ChildProcess* node : nodes) before.push_back(node->processor_seconds());
    scene.pictures = 0;
    const ros::WallTime start = ros::WallTime::now();
    for (int i = 0; i < messages; ++i) {
      if (i % static_cast<int>(rate) == 0) scene.send_wind();
      what.send();
      spin_for((start + ros::WallDuration((i + 1) / rate) - ros::WallTime::now()).toSec());
    }
    const double seconds = (ros::WallTime::now() - start).toSec();
    fmt::print("{:<24}", what.name);
    for (std::size_t i = 0; i < nodes.size(); ++i)
      fmt::print("{:>{}.2f}", 100 * (nodes[i]->processor_seconds() - before[i]) / seconds, i == 0 ? 16 : 13);
    fmt::print("{:>12}\n", scene.pictures);
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace
}  // namespace aeolian

int main(int argc, char** argv) { return aeolian::run(argc, argv); }
