#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <ros/ros.h>

namespace aeolian {

/// Spins until something is so; false when it is not within some seconds of wall time.
inline bool wait_until(const std::function<bool()>& so, double seconds = 10) {
  const ros::WallTime end = ros::WallTime::now() + ros::WallDuration(seconds);
  while (ros::ok() && ros::WallTime::now() < end) {
    ros::spinOnce();
    if (so()) return true;
    ros::WallDuration(0.005).sleep();
  }
  return false;
}

/// Everything that arrived on a topic.
template <class Message>
class Listener {
 public:
  Listener(ros::NodeHandle& nh, const std::string& topic) {
    const boost::function<void(const typename Message::ConstPtr&)> take =
        [this](const typename Message::ConstPtr& m) { messages.push_back(m); };
    subscriber_ = nh.subscribe<Message>(topic, 1000, take);
  }
  bool connected() const { return subscriber_.getNumPublishers() > 0; }

  std::vector<typename Message::ConstPtr> messages;

 private:
  ros::Subscriber subscriber_;
};

/// What the nodes say in their diagnostics.
class Diagnostics {
 public:
  explicit Diagnostics(ros::NodeHandle& nh) : listener_(nh, "/diagnostics") {}

  /// Whether from now on a node warns with a text in its line.
  bool warns(const std::string& node, const std::string& text) {
    return says(node, diagnostic_msgs::DiagnosticStatus::WARN, text);
  }
  /// Whether a node has started.
  bool is_up(const std::string& node) {
    return wait_until([&] {
      for (const auto& array : listener_.messages)
        for (const auto& status : array->status)
          if (status.name.find(node) == 0 && status.message != "Node starting up") return true;
      return false;
    });
  }
  bool is_well(const std::string& node) {
    return says(node, diagnostic_msgs::DiagnosticStatus::OK, "running");
  }

 private:
  bool says(const std::string& node, int level, const std::string& text) {
    std::string last;
    const bool said = wait_until([&] {
      for (const auto& array : listener_.messages)
        for (const auto& status : array->status) {
          if (status.name.find(node) != 0) continue;
          last = status.message;
          if (status.level == level && last.find(text) != std::string::npos) return true;
        }
      listener_.messages.clear();
      return false;
    });
    EXPECT_TRUE(said) << node << " says '" << last << "', expected '" << text << "'";
    listener_.messages.clear();
    return said;
  }

  Listener<diagnostic_msgs::DiagnosticArray> listener_;
};

}  // namespace aeolian
