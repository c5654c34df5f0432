/// A node as a program of its own; the build compiles this file once for each, with NODE as its name.

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <string>

#include <ros/ros.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace {

aeolian::NodeDescription describe(const std::string& name) {
  for (const aeolian::NodeDescription& node : aeolian::all_nodes())
    if (node.name == name) return node;
  throw aeolian::Error("there is no node '" + name + "'");
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const aeolian::NodeDescription node = describe(NODE);
    if (std::any_of(argv + 1, argv + argc, [](const std::string& a) { return a == "--help" || a == "-h"; })) {
      std::cout << aeolian::help_text(node);
      return 0;
    }
    ros::init(argc, argv, node.name);
    if (argc > 1) throw aeolian::Error(std::string("unknown argument '") + argv[1] + "', see --help");
    const auto nodelet = node.make();
    nodelet->init(ros::this_node::getName(), {}, {});
    ros::spin();
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", NODE, error.what());
    return 1;
  }
}
