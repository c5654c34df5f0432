#include "aeolian_twin/replay/replay_config.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>

#include <XmlRpcValue.h>
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace aeolian {
namespace {

using XmlRpc::XmlRpcValue;

template <class Number>
std::optional<Number> whole_as(const std::string& text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || rest != end) return std::nullopt;
  return number;
}

XmlRpcValue to_scalar(const YAML::Node& node) {
  const std::string& text = node.Scalar();
  if (node.Tag() == "!") return text;  // in quotes
  if (text == "true" || text == "false") return XmlRpcValue(text == "true");
  if (const auto number = whole_as<int>(text)) return *number;
  if (const auto number = whole_as<double>(text)) return *number;
  return text;
}

/// A YAML value as roslaunch would set it on the parameter server.
XmlRpcValue to_parameter(const YAML::Node& node) {
  XmlRpcValue value;
  if (node.IsMap())
    for (const auto& entry : node) value[entry.first.Scalar()] = to_parameter(entry.second);
  else if (node.IsSequence())
    for (std::size_t i = 0; i < node.size(); ++i) value[static_cast<int>(i)] = to_parameter(node[i]);
  else if (node.IsScalar())
    value = to_scalar(node);
  return value;
}

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error(path + ": cannot be read");
  return text;
}

YAML::Node parse(const std::string& path, const std::string& text) {
  try {
    YAML::Node root = YAML::Load(text);
    if (!root.IsMap()) throw Error(path + ": must have a section for each node");
    return root;
  } catch (const YAML::Exception& error) {
    throw Error(fmt::format("{}:{}: {}", path, error.mark.line + 1, error.msg));
  }
}

/// The sections of the file, each as a node's private namespace.
class Sections {
 public:
  Sections(const std::string& path, const std::string& text) : path_(path) {
    for (const auto& entry : parse(path, text)) {
      const std::string& name = entry.first.Scalar();
      if (entry.second.IsNull()) continue;
      if (!entry.second.IsMap())
        throw Error(fmt::format("{}:{}: {} must be a section of 'name: value' lines", path,
                                entry.first.Mark().line + 1, name));
      const auto known = {"topics", "height_mapper", "wind_estimator", "forecaster", "comparator"};
      if (std::find(known.begin(), known.end(), name) == known.end())
        throw Error(fmt::format("{}:{}: there is no section '{}', must be one of {}", path,
                                entry.first.Mark().line + 1, name, fmt::join(known, ", ")));
      values_[name] = to_parameter(entry.second);
    }
  }

  std::string where(const std::string& section) const { return path_ + ": " + section; }
  const XmlRpcValue& values(const std::string& section) { return values_[section]; }

  Parameters parameters(const std::string& section, const std::vector<ParameterDeclaration>& declared) {
    Parameters result(declared, where(section), values(section));
    if (!result.unknown().empty())
      throw Error(where(section) + "/" + result.unknown().front() + ": there is no such parameter");
    return result;
  }

 private:
  std::string path_;
  std::map<std::string, XmlRpcValue> values_;
};

ReplayConfig::Topics read_topics(Sections& sections) {
  ReplayConfig::Topics topics;
  const std::array<std::pair<const char*, std::string*>, 5> all{{{"points", &topics.points},
                                                                 {"wind", &topics.wind},
                                                                 {"wind_ahead", &topics.wind_ahead},
                                                                 {"tf", &topics.tf},
                                                                 {"tf_static", &topics.tf_static}}};
  std::vector<ParameterDeclaration> declared;
  for (const auto& [name, topic] : all) declared.push_back({name, *topic, "", "topic of the bag"});
  const Parameters given = sections.parameters("topics", declared);
  for (const auto& [name, topic] : all) *topic = given.text(name);
  return topics;
}

/// A name as a node without a namespace would resolve it.
std::string resolved(const std::string& topic) { return topic.rfind('/', 0) == 0 ? topic : "/" + topic; }

/// What a live node does with its map beside publishing it has no place here.
void require_whole_maps(const Parameters& mapper) {
  if (mapper.flag("incremental")) mapper.refuse("incremental", "false: a replay gives whole maps");
  if (mapper.number("autosave_period") > 0)
    mapper.refuse("autosave_period", "0: a replay saves no map but its bag");
}

}  // namespace

ReplayConfig ReplayConfig::read(const std::string& path) {
  std::string text = text_of(path);
  Sections sections(path, text);
  Topics topics = read_topics(sections);
  const auto of = [&](const NodeDescription& node) {
    return sections.parameters(node.name, node.parameters);
  };
  ReplayConfig config{topics,
                      of(describe_height_mapper()),
                      of(describe_wind_estimator()),
                      of(describe_forecaster()),
                      of(describe_comparator()),
                      {},
                      {},
                      std::move(text),
                      {}};
  require_whole_maps(config.height_mapper);
  const SensorSettings shared = read_sensor(config.height_mapper, "", topics.points);
  config.noise = shared.noise;
  config.sensors = read_sensors(sections.where("height_mapper"), sections.values("height_mapper"), shared);
  for (SensorSettings& sensor : config.sensors) sensor.topic = resolved(sensor.topic);
  config.files = {config.height_mapper.text("sensor_file"), config.forecaster.text("saltation"),
                  config.forecaster.text("wind_ahead_file"), config.forecaster.text("learned_file")};
  return config;
}

}  // namespace aeolian
