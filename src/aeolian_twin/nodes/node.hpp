#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <diagnostic_updater/diagnostic_updater.h>
#include <nodelet/nodelet.h>
#include <ros/ros.h>
#include <std_msgs/Header.h>

#include "aeolian_twin/nodes/health.hpp"
#include "aeolian_twin/nodes/parameters.hpp"

namespace aeolian {

/// What a person must know of a node; `height_mapper --help` prints it.
struct NodeDescription {
  std::string name;
  std::string help;  ///< what it does, one line
  std::vector<std::string> takes;
  std::vector<std::string> gives;
  std::vector<ParameterDeclaration> parameters;
  std::function<std::shared_ptr<nodelet::Nodelet>()> make;
};

/// Each node's description stands in its own file, beside its class.
NodeDescription describe_height_mapper();
NodeDescription describe_shadow_profiler();
NodeDescription describe_wind_estimator();
NodeDescription describe_forecaster();
NodeDescription describe_comparator();
NodeDescription describe_forecast_shelf();
NodeDescription describe_slide_forecaster();
NodeDescription describe_surface_display();

/// All of them.
std::vector<NodeDescription> all_nodes();
/// The text of --help.
std::string help_text(const NodeDescription& node);

/// What our nodelets share: parameters checked at start-up, diagnostics once a second of wall time (so that
/// they go on when a bag is paused), and one way to say what is well and what is not.
class Node : public nodelet::Nodelet {
 protected:
  explicit Node(const NodeDescription& description) : declarations_(description.parameters) {}

  /// Called once with valid parameters: read them, advertise, subscribe. An Error stops the node.
  virtual void start() = 0;
  /// Called before each diagnostic, to notice what did not happen.
  virtual void watch() {}

  ros::NodeHandle& nh() { return getNodeHandle(); }
  ros::NodeHandle& private_nh() { return getPrivateNodeHandle(); }
  const Parameters& parameters() const { return *parameters_; }

  /// States that a thing ("clouds") is well or not, in one line; shown in the diagnostics, and in the log
  /// when it turns. Safe from any thread.
  void good(const std::string& thing, const std::string& line);
  void bad(const std::string& thing, const std::string& line);
  /// Throws Error naming both frames unless the header is in `~frame_id`.
  void require_frame(const std::string& topic, const std_msgs::Header& header) const;

 private:
  void onInit() final;

  std::vector<ParameterDeclaration> declarations_;
  std::unique_ptr<Parameters> parameters_;
  Health health_;
  std::unique_ptr<diagnostic_updater::Updater> updater_;
  ros::WallTimer timer_;
};

/// The parameter that all nodes have.
ParameterDeclaration frame_parameter();

}  // namespace aeolian
