#include "aeolian_twin/nodes/node.hpp"

#include <fstream>
#include <set>

#include <gtest/gtest.h>
#include <yaml-cpp/yaml.h>

namespace aeolian {
namespace {

std::string config_file(const std::string& node) {
  return std::string(AEOLIAN_REPOSITORY) + "/config/" + node + ".yaml";
}

/// A YAML value as the kind that a declaration's default has.
ParameterValue read_as(const ParameterValue& kind, const YAML::Node& value) {
  return std::visit([&](const auto& v) -> ParameterValue { return value.as<std::decay_t<decltype(v)>>(); },
                    kind);
}

TEST(Config, HoldsExactlyTheDeclaredParametersWithTheirDefaults) {
  for (const NodeDescription& node : all_nodes()) {
    const YAML::Node config = YAML::LoadFile(config_file(node.name));
    std::set<std::string> left;
    for (const auto& entry : config) left.insert(entry.first.as<std::string>());
    for (const ParameterDeclaration& declared : node.parameters) {
      EXPECT_EQ(left.erase(declared.name), 1U)
          << node.name << ": " << declared.name << " is not in the YAML file";
      const YAML::Node value = config[declared.name];
      if (!value.IsDefined()) continue;
      EXPECT_EQ(read_as(declared.fallback, value), declared.fallback) << node.name << ": " << declared.name;
    }
    for (const std::string& name : left) ADD_FAILURE() << node.name << ": nobody declares " << name;
  }
}

TEST(Config, EveryLineIsCommented) {
  for (const NodeDescription& node : all_nodes()) {
    std::ifstream file(config_file(node.name));
    for (std::string line; std::getline(file, line);)
      EXPECT_NE(line.find("# "), std::string::npos) << node.name << ": " << line;
  }
}

TEST(Help, HasALineForEachParameter) {
  for (const NodeDescription& node : all_nodes()) {
    const std::string text = help_text(node);
    for (const ParameterDeclaration& declared : node.parameters) {
      EXPECT_FALSE(declared.help.empty()) << node.name << ": " << declared.name;
      EXPECT_NE(text.find("~" + declared.name), std::string::npos);
      EXPECT_NE(text.find("(default " + to_text(declared.fallback) + ")"), std::string::npos);
    }
  }
}

TEST(Health, AComplaintIsReportedAtLeastOnce) {
  Health health;
  health.good("clouds", "fine");
  EXPECT_TRUE(health.bad("clock", "time jumped back"));
  health.good("clock", "time runs forward");
  diagnostic_msgs::DiagnosticStatus first;
  health.fill(first);
  EXPECT_EQ(first.level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_EQ(first.message, "time jumped back");
  diagnostic_msgs::DiagnosticStatus second;
  health.fill(second);
  EXPECT_EQ(second.level, diagnostic_msgs::DiagnosticStatus::OK);
  ASSERT_EQ(second.values.size(), 2U);
  EXPECT_EQ(second.values[1].key, "clouds");
  EXPECT_EQ(second.values[1].value.find("fine (since "), 0U);
}

TEST(Health, LastsUntilItIsWell) {
  Health health;
  health.bad("clouds", "none");
  for (int i = 0; i < 3; ++i) {
    diagnostic_msgs::DiagnosticStatus status;
    health.fill(status);
    EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
  }
}

TEST(Health, TheLogIsNotFlooded) {
  Health health;
  EXPECT_TRUE(health.bad("clouds", "no points"));
  EXPECT_FALSE(health.bad("clouds", "no points"));
  EXPECT_TRUE(health.good("clouds", "fine"));
  int told = 0;
  for (int i = 0; i < 1000; ++i) {
    told += health.bad("clouds", "bad " + std::to_string(i)) ? 1 : 0;
    told += health.good("clouds", "fine") ? 1 : 0;
  }
  EXPECT_EQ(told, 0);
}

}  // namespace
}  // namespace aeolian
