#pragma once

#include <string>
#include <vector>

#include <aeolian_msgs/ProbeWind.h>
#include <geometry_msgs/PoseArray.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <tf2/buffer_core.h>

#include "aeolian_twin/nodes/tell.hpp"
#include "aeolian_twin/nodes/wind_prober.hpp"

namespace aeolian {

/// The wind at points, as a topic (`probes` in, `probe_wind` out, for each new set of points and each new
/// wind while somebody listens) and as a service (`probe_wind`).
class WindProbes {
 public:
  /// `frame` of the maps; `reader` and `transforms` must outlive this.
  WindProbes(ros::NodeHandle& node, WindReader& reader, const std::string& frame,
             const tf2::BufferCore& transforms, Tell tell);
  WindProbes(const WindProbes&) = delete;
  WindProbes& operator=(const WindProbes&) = delete;

  /// There is a new wind.
  void note_wind();

 private:
  using Service = aeolian_msgs::ProbeWind;

  void take_points(const geometry_msgs::PoseArray::ConstPtr& message);
  bool answer(Service::Request& request, Service::Response& response);
  aeolian_msgs::WindAtPoints message(const std::vector<ProbeReading>& readings,
                                     const std::vector<Eigen::Vector3d>& points) const;
  Eigen::Isometry3d pose_of(const std::string& frame) const;

  WindReader& reader_;
  std::string frame_;
  const tf2::BufferCore& transforms_;
  Tell tell_;
  WindProber prober_;
  std::vector<Eigen::Vector3d> points_;  ///< that were last asked for on the topic
  ros::Publisher publisher_;
  ros::Subscriber subscriber_;
  ros::ServiceServer server_;
};

}  // namespace aeolian
