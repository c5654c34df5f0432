#include "aeolian_twin/nodes/node.hpp"

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/frame_check.hpp"

namespace aeolian {
namespace {

const std::string diagnostic_period = "diagnostic_period";  // of ROS's own diagnostics [s]

}  // namespace

std::vector<NodeDescription> all_nodes() {
  return {describe_height_mapper(),  describe_shadow_profiler(), describe_wind_estimator(),
          describe_forecaster(),     describe_comparator(),      describe_forecast_shelf(),
          describe_surface_display()};
}

std::string help_text(const NodeDescription& node) {
  std::string text = fmt::format(
      "{0}: {1}\n\nrosrun aeolian_twin {0} [__name:=other_name] [_parameter:=value]\n", node.name, node.help);
  const auto list = [&text](const std::string& title, const std::vector<std::string>& lines) {
    text += "\n" + title + "\n";
    for (const std::string& line : lines) text += "  " + line + "\n";
  };
  list("Takes", node.takes);
  list("Gives", node.gives);
  text += "\nParameters\n";
  for (const ParameterDeclaration& p : node.parameters) {
    text += fmt::format("  ~{:<22} {}{}", p.name, p.help, p.unit.empty() ? "" : " [" + p.unit + "]");
    if (!p.choices.empty()) text += fmt::format(": {}", fmt::join(p.choices, ", "));
    text += fmt::format(" (default {})\n", to_text(p.fallback));
  }
  return text;
}

ParameterDeclaration frame_parameter() {
  return {"frame_id", std::string("map"), "", "frame of the maps, z up"};
}

void Node::onInit() {
  const std::string name = private_nh().getNamespace();
  XmlRpc::XmlRpcValue values;
  ros::param::get(name, values);
  parameters_ = std::make_unique<Parameters>(declarations_, name, values);
  for (const std::string& unknown : parameters_->unknown())
    if (unknown != diagnostic_period)
      NODELET_WARN_STREAM(name << "/" << unknown
                               << ": there is no such parameter, see --help; it is ignored");

  updater_ = std::make_unique<diagnostic_updater::Updater>(nh(), private_nh(), name);
  updater_->setHardwareID("none");
  updater_->add("state",
                [this](diagnostic_updater::DiagnosticStatusWrapper& status) { health_.fill(status); });
  start();
  const ros::WallDuration period(private_nh().param(diagnostic_period, 1.0));
  timer_ = nh().createWallTimer(period, [this](const ros::WallTimerEvent&) {
    watch();
    updater_->force_update();
  });
}

void Node::good(const std::string& thing, const std::string& line) {
  if (health_.good(thing, line)) NODELET_INFO_STREAM(thing << ": " << line);
}

void Node::bad(const std::string& thing, const std::string& line) {
  if (health_.bad(thing, line)) NODELET_WARN_STREAM(thing << ": " << line);
}

void Node::require_frame(const std::string& topic, const std_msgs::Header& header) const {
  aeolian::require_frame(topic, header, *parameters_);
}

}  // namespace aeolian
