#include "aeolian_twin/nodes/wind_probes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

constexpr std::size_t most_samples = 1000000;  ///< of gusts, for all points of one request

}  // namespace

WindProbes::WindProbes(ros::NodeHandle& node, WindReader& reader, const std::string& frame,
                       const tf2::BufferCore& transforms, Tell tell)
    : reader_(reader), frame_(frame), transforms_(transforms), tell_(std::move(tell)), prober_(reader) {
  publisher_ = node.advertise<aeolian_msgs::WindAtPoints>("probe_wind", 10);
  subscriber_ = node.subscribe("probes", 10, &WindProbes::take_points, this);
  server_ = node.advertiseService("probe_wind", &WindProbes::answer, this);
}

void WindProbes::note_wind() {
  if (points_.empty() || publisher_.getNumSubscribers() == 0 || !reader_.field()) return;
  try {
    const std::vector<ProbeReading> readings = prober_.at(points_);
    const auto unknown = std::count_if(readings.begin(), readings.end(), [](const ProbeReading& reading) {
      return !std::isfinite(reading.mean.east);
    });
    publisher_.publish(message(readings, points_));
    tell_("probes", unknown == 0,
          unknown == 0 ? fmt::format("the wind at {} points", points_.size())
                       : fmt::format("{} of {} points are beside the map, in the ground or in its roughness",
                                     unknown, points_.size()));
  } catch (const Error& error) {
    tell_("probes", false, error.what());
  }
}

void WindProbes::take_points(const geometry_msgs::PoseArray::ConstPtr& message) {
  try {
    const Eigen::Isometry3d pose = pose_of(message->header.frame_id);
    points_.clear();
    for (const geometry_msgs::Pose& point : message->poses)
      points_.emplace_back(pose * Eigen::Vector3d(point.position.x, point.position.y, point.position.z));
    note_wind();
  } catch (const Error& error) {
    tell_("probes", false, subscriber_.getTopic() + ": " + error.what());
  }
}

bool WindProbes::answer(Service::Request& request, Service::Response& response) {
  try {
    if (request.gust_samples * request.points.size() > most_samples)
      throw Error(fmt::format("gust_samples is {} for each of {} points, must be at most {} in all",
                              request.gust_samples, request.points.size(), most_samples));
    const Eigen::Isometry3d pose = pose_of(request.header.frame_id);
    std::vector<Eigen::Vector3d> points;
    for (const geometry_msgs::Point& point : request.points)
      points.emplace_back(pose * Eigen::Vector3d(point.x, point.y, point.z));
    const std::vector<ProbeReading> readings = prober_.at(points);
    response.wind = message(readings, points);
    if (request.gust_samples > 0)
      for (const Gusts& gusts :
           prober_.gusts(points, readings, request.gust_step, request.gust_samples, request.seed))
        response.gusts.push_back(gusts.along.empty() ? aeolian_msgs::GustRecord() : to_message(gusts));
    response.success = 1;
  } catch (const Error& error) {
    response.success = 0;
    response.message = error.what();
  }
  return true;
}

aeolian_msgs::WindAtPoints WindProbes::message(const std::vector<ProbeReading>& readings,
                                               const std::vector<Eigen::Vector3d>& points) const {
  aeolian_msgs::WindAtPoints result = to_message(readings, points, reader_.header());
  result.model = reader_.field()->model;
  return result;
}

/// Of a frame in that of the maps, by the latest that tf knows.
Eigen::Isometry3d WindProbes::pose_of(const std::string& frame) const {
  if (frame.empty() || frame == frame_) return Eigen::Isometry3d::Identity();
  try {
    return tf2::transformToEigen(transforms_.lookupTransform(frame_, frame, ros::Time(0)));
  } catch (const tf2::TransformException& error) {
    throw Error(error.what());
  }
}

}  // namespace aeolian
