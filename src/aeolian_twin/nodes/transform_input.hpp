#pragma once

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

namespace aeolian {

/// Takes the transforms of tf into a buffer, on a thread that sleeps until some come. The thread of
/// tf2_ros::TransformListener looks a hundred times a second: most of what a node costs that has nothing to
/// do.
class TransformInput {
 public:
  /// `buffer` must outlive this.
  explicit TransformInput(tf2_ros::Buffer& buffer)
      : node_(on(queue_)), listener_(buffer, node_, /*spin_thread=*/false), spinner_(1, &queue_) {
    buffer.setUsingDedicatedThread(true);
    spinner_.start();
  }
  TransformInput(const TransformInput&) = delete;
  TransformInput& operator=(const TransformInput&) = delete;

 private:
  static ros::NodeHandle on(ros::CallbackQueue& queue) {
    ros::NodeHandle node;
    node.setCallbackQueue(&queue);
    return node;
  }

  ros::CallbackQueue queue_;
  ros::NodeHandle node_;
  tf2_ros::TransformListener listener_;
  ros::AsyncSpinner spinner_;
};

}  // namespace aeolian
