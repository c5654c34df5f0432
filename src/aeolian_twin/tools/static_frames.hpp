#pragma once

#include <string>

#include <rosbag/bag.h>
#include <tf2_msgs/TFMessage.h>

namespace aeolian {

/// Writes frames that never move to /tf_static, latched, so that a player shows them to whoever comes late.
inline void write_static_frames(rosbag::Bag& bag, const tf2_msgs::TFMessage& frames, const ros::Time& stamp,
                                const std::string& program) {
  namespace traits = ros::message_traits;
  const auto connection = boost::make_shared<ros::M_string>(
      ros::M_string{{"topic", "/tf_static"},
                    {"type", traits::datatype<tf2_msgs::TFMessage>()},
                    {"md5sum", traits::md5sum<tf2_msgs::TFMessage>()},
                    {"message_definition", traits::definition<tf2_msgs::TFMessage>()},
                    {"callerid", "/" + program},
                    {"latching", "1"}});
  bag.write("/tf_static", stamp, frames, connection);
}

}  // namespace aeolian
