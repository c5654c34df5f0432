// What the twin costs while it runs: height_mapper, wind_estimator, forecaster and comparator as programs
// under a master, clouds of 640 x 480 points at 10 Hz over TCP onto 1 m x 0.5 m of ripples that migrate, at 2
// mm, wind at 10 Hz, a forecast each 10 s with 20 members. The table gives processor time in per cent of one
// core.
//
//     ./twin bench live_twin

#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "child_process.hpp"
#include "own_master.hpp"
#include "scanned_ripples.hpp"
#include <geometry_msgs/TwistStamped.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/static_transform_broadcaster.h>

#include "aeolian_twin/nodes/conversions.hpp"

namespace {

using namespace aeolian;

constexpr double rate = 10;
constexpr int warm_up = 400;   // so that there are forecasts to be scored
constexpr int measured = 600;  // a minute

sensor_msgs::PointCloud2 cloud_at(double time, std::uint64_t number) {
  sensor_msgs::PointCloud2 message = to_message(bench::ScannedRipples().at(time, number), 640);
  message.header.frame_id = "camera";
  return message;
}

/// A node and what it had used when the warm-up was over.
struct Measured {
  std::string name;
  std::unique_ptr<ChildProcess> process;
  double before = 0;

  Measured(std::string its_name, const std::vector<std::string>& parameters) : name(std::move(its_name)) {
    std::vector<std::string> command{std::string(AEOLIAN_BIN) + "/" + name};
    command.insert(command.end(), parameters.begin(), parameters.end());
    process = std::make_unique<ChildProcess>(command, SIGINT, ChildProcess::Output::dropped);
  }
};

void measure(double publish_period, ros::NodeHandle& node) {
  ros::Publisher points = node.advertise<sensor_msgs::PointCloud2>("points", 4);
  ros::Publisher winds = node.advertise<geometry_msgs::TwistStamped>("wind", 10);
  std::vector<Measured> nodes;
  nodes.emplace_back("height_mapper",
                     std::vector<std::string>{"_cell_size:=0.002", "_range_sigma:=0.0006",
                                              "_publish_period:=" + std::to_string(publish_period)});
  nodes.emplace_back("wind_estimator", std::vector<std::string>{"_grain_diameter:=0.0004"});
  nodes.emplace_back("forecaster", std::vector<std::string>{"_grain_diameter:=0.0004", "_period:=10.0"});
  nodes.emplace_back("comparator", std::vector<std::string>{"_max_pending:=200"});
  while (ros::ok() && (points.getNumSubscribers() == 0 || winds.getNumSubscribers() == 0))
    ros::WallDuration(0.1).sleep();

  const ros::Time start(1700000000);
  ros::WallRate tick(rate);
  for (int i = 0; i < warm_up + measured && ros::ok(); ++i) {
    if (i == warm_up)
      for (Measured& each : nodes) each.before = each.process->processor_seconds();
    const double time = i / rate;
    sensor_msgs::PointCloud2 cloud = cloud_at(time, static_cast<std::uint64_t>(i));
    geometry_msgs::TwistStamped wind;
    cloud.header.stamp = wind.header.stamp = start + ros::Duration(time);
    wind.header.frame_id = "map";
    wind.twist.linear.x = 12.6 + std::sin(time);
    winds.publish(wind);
    points.publish(cloud);
    ros::spinOnce();
    tick.sleep();
  }
  std::printf("| %3.1f |", publish_period);
  double sum = 0;
  for (const Measured& each : nodes) {
    const double share = 100 * (each.process->processor_seconds() - each.before) / (measured / rate);
    std::printf(" %5.1f |", share);
    sum += share;
  }
  std::printf(" %5.1f |\n", sum);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const bench::OwnMaster master;
  ros::init(argc, argv, "live_twin_bench", ros::init_options::NoSigintHandler);
  while (!ros::master::check()) ros::WallDuration(0.1).sleep();
  ros::NodeHandle node;
  tf2_ros::StaticTransformBroadcaster broadcaster;
  broadcaster.sendTransform(bench::camera_pose(ros::Time::now(), 0.5, 0.25));
  std::printf(
      "| ~publish_period | height_mapper | wind_estimator | forecaster | comparator | all, %% of a core |\n"
      "|---|---|---|---|---|---|\n");
  for (const double period : {1.0, 0.0}) measure(period, node);
  return 0;
}
