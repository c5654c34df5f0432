#pragma once

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <variant>

#include <aeolian_msgs/WindAhead.h>
#include <geometry_msgs/TwistStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <tf2_msgs/TFMessage.h>

#include "aeolian_twin/replay/bounded_queue.hpp"
#include "aeolian_twin/replay/read_cloud.hpp"
#include "aeolian_twin/replay/replay_config.hpp"

namespace aeolian {

/// The messages of a recorded bag that the twin takes, in the bag's order. They are read, unpacked and
/// converted in a thread of its own, a few messages ahead.
class BagSource {
 public:
  struct Transforms {
    tf2_msgs::TFMessageConstPtr message;
    bool are_static;
  };
  struct Cloud {
    boost::shared_ptr<const ReadCloud> message;
    std::string topic;
  };
  using Content =
      std::variant<Transforms, Cloud, geometry_msgs::TwistStampedConstPtr, aeolian_msgs::WindAheadConstPtr>;
  struct Message {
    ros::Time time;    ///< of the recording
    double share = 0;  ///< of the bag's time that has passed, 0 to 1
    Content content;
  };

  /// Throws Error in one line for a bag that cannot be read, was cut off or lacks clouds or wind, and for a
  /// topic of another type.
  BagSource(const std::string& path, const ReplayConfig& config);
  BagSource(const BagSource&) = delete;
  BagSource& operator=(const BagSource&) = delete;
  ~BagSource();

  /// The next message; nothing at the end. Throws Error where the bag is broken.
  std::optional<Message> next();

 private:
  void read_ahead();
  Message read(const rosbag::MessageInstance& instance) const;

  std::string path_;
  ReplayConfig::Topics topics_;
  rosbag::Bag bag_;
  std::unique_ptr<rosbag::View> view_;
  BoundedQueue<Message> ahead_;
  std::exception_ptr failure_;  ///< of the thread; read after the end
  std::thread reader_;
};

}  // namespace aeolian
