#pragma once

#include <functional>
#include <optional>
#include <string>

#include <Eigen/Geometry>
#include <ros/time.h>
#include <std_msgs/Header.h>
#include <tf2/buffer_core.h>

#include "aeolian_core/surface/point_cloud.hpp"
#include "aeolian_twin/nodes/sensor_settings.hpp"
#include "aeolian_twin/nodes/tell.hpp"

namespace aeolian {

/// Where tf says that the clouds of one sensor were measured, and what is amiss with that. Needs no master.
class CloudPlacer {
 public:
  struct Frames {
    tf2::BufferCore& buffer;
    std::string map;             ///< where clouds are brought to
    ros::WallDuration patience;  ///< a transform that is missing for so long is told of
    std::uint32_t queue_size;    ///< clouds that may wait for theirs
  };
  /// Of one cloud.
  struct Place {
    Eigen::Isometry3d pose;  ///< brings it to the map's frame
    ros::Time measured;
  };
  /// Takes a cloud and its place; throws Error for one that it cannot use.
  using Use = std::function<void(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                 const ros::Time& measured, const SensorSettings& sensor)>;

  CloudPlacer(const SensorSettings& sensor, const Frames& frames, Use use, Tell tell);

  /// To be called for every cloud before it waits for its transform. True: time has jumped back, the
  /// transforms before the jump are forgotten, and so must be the clouds that wait.
  bool arrived(const std_msgs::Header& header);
  /// A cloud whose transform did not come in time.
  void dropped(const std_msgs::Header& header);
  /// A cloud whose transform is known: `read` gives its points, or throws Error.
  template <class Read>
  void take(const std_msgs::Header& header, Read&& read) {
    take_if(header, [&](const Place& place) { use_(read(), place.pose, place.measured, sensor_); });
  }
  /// To be called now and then: tells of a transform that does not come.
  void watch();

 private:
  void take_if(const std_msgs::Header& header, const std::function<void(const Place&)>& use);
  void tell_of_transform(const std_msgs::Header& header);
  void tell(const std::string& thing, bool well, const std::string& line);

  SensorSettings sensor_;
  Frames frames_;
  Use use_;
  Tell tell_;
  int waiting_ = 0;  ///< clouds whose transform is not known yet
  ros::WallTime waiting_since_;
  std_msgs::Header waiting_header_;  ///< of the newest of them
  ros::Time newest_arrived_;
};

}  // namespace aeolian
