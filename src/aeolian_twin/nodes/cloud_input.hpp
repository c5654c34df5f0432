#pragma once

#include <utility>

#include <ros/callback_queue_interface.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/message_filter.h>

#include "aeolian_twin/nodes/cloud_placer.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

/// The points of a message, in memory that serves again.
inline const PointCloud& points_of(const sensor_msgs::PointCloud2& message, PointCloud& memory) {
  memory = to_point_cloud(message, std::move(memory));
  return memory;
}

/// The clouds of one sensor, each with the pose that tf gives for when it was measured: a cloud waits until
/// tf knows it. What is amiss is told, and the next cloud is waited for. Needs no master.
///
/// `Message` has a header and is what points_of() takes.
template <class Message>
class CloudInput {
 public:
  using ConstPtr = boost::shared_ptr<const Message>;

  /// Clouds are used in the callbacks of `queue`, or, when it is null, at once: within add() or where the
  /// transform enters the buffer.
  CloudInput(const SensorSettings& sensor, const CloudPlacer::Frames& frames, CloudPlacer::Use use, Tell tell,
             ros::CallbackQueueInterface* queue)
      : placer_(sensor, frames, std::move(use), std::move(tell)),
        filter_(frames.buffer, frames.map, frames.queue_size, queue) {
    filter_.registerCallback(&CloudInput::take, this);
    filter_.registerFailureCallback([this](const ConstPtr& cloud, auto) { placer_.dropped(cloud->header); });
  }
  CloudInput(const CloudInput&) = delete;
  CloudInput& operator=(const CloudInput&) = delete;

  void add(const ConstPtr& cloud) {
    if (placer_.arrived(cloud->header)) filter_.clear();
    filter_.add(cloud);
  }
  /// To be called now and then: tells of a transform that does not come.
  void watch() { placer_.watch(); }

 private:
  void take(const ConstPtr& cloud) {
    placer_.take(cloud->header, [&]() -> decltype(auto) { return points_of(*cloud, points_); });
  }

  CloudPlacer placer_;
  PointCloud points_;  ///< memory for those of a message
  tf2_ros::MessageFilter<Message> filter_;
};

}  // namespace aeolian
