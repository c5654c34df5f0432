#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

/// A section of a YAML file, read strictly: every key that is asked for must be there, be of its type and in
/// its range, and no other may be. Errors name the file, the line, the key with its sections, the value and
/// what is allowed.
///
///     YamlSection root = YamlSection::load(path);
///     YamlSection wind = root.section("wind");
///     const double speed = wind.number("mean_speed_m_s", 0, 100);
///     wind.finish();
class YamlSection {
 public:
  static YamlSection load(const std::string& path) {
    try {
      return {YAML::LoadFile(path), path, ""};
    } catch (const YAML::BadFile&) {
      throw Error(path + ": cannot be read");
    } catch (const YAML::Exception& e) {
      throw Error(fmt::format("{}:{}: {}", path, e.mark.line + 1, e.msg));
    }
  }

  /// A number from `low` to `high`, both allowed.
  double number(const std::string& key, double low, double high) {
    return checked(key, take(key), low, high);
  }

  /// A number greater than zero.
  double positive(const std::string& key, double high = 1e12) {
    return number(key, std::numeric_limits<double>::min(), high);
  }

  int integer(const std::string& key, int low, int high) {
    const YAML::Node node = take(key);
    const double value = checked(key, node, low, high);
    if (value != std::floor(value)) fail(key, node, "must be a whole number");
    return static_cast<int>(value);
  }

  std::string text(const std::string& key) {
    const YAML::Node node = take(key);
    if (!node.IsScalar() || node.Scalar().empty()) fail(key, node, "must be a text");
    return node.Scalar();
  }

  /// [x, y, z] in metres.
  Eigen::Vector3d point(const std::string& key) {
    const YAML::Node node = take(key);
    if (!node.IsSequence() || node.size() != 3) fail(key, node, "must be three numbers [x, y, z]");
    constexpr double far = 1000;
    return {checked(key, node[0], -far, far), checked(key, node[1], -far, far),
            checked(key, node[2], -far, far)};
  }

  bool flag(const std::string& key) {
    const YAML::Node node = take(key);
    try {
      return node.as<bool>();
    } catch (const YAML::Exception&) {
      fail(key, node, "must be true or false");
    }
  }

  /// For keys that may be absent.
  bool has(const std::string& key) const {
    const YAML::Node node = node_[key];
    return node.IsDefined() && !node.IsNull();
  }

  /// A list of numbers; exactly `count` of them unless that is zero.
  std::vector<double> numbers(const std::string& key, std::size_t count = 0) {
    const YAML::Node node = take(key);
    if (!node.IsSequence() || (count > 0 && node.size() != count))
      fail(key, node,
           count > 0 ? fmt::format("must be a list of {} numbers", count) : "must be a list of numbers");
    std::vector<double> result;
    for (const YAML::Node& element : node) result.push_back(checked(key, element, -1e12, 1e12));
    return result;
  }

  /// A list of lists, each of `fewest` to `most` numbers within the limits; at least one.
  std::vector<std::vector<double>> rows(const std::string& key, std::size_t fewest, std::size_t most,
                                        double low = -1e12, double high = 1e12) {
    const YAML::Node node = take(key);
    if (!node.IsSequence() || node.size() == 0) fail(key, node, "must be a list of at least one");
    std::vector<std::vector<double>> result;
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string name = fmt::format("{}[{}]", key, i);
      if (!node[i].IsSequence() || node[i].size() < fewest || node[i].size() > most)
        fail(name, node[i],
             fewest == most ? fmt::format("must be a list of {} numbers", fewest)
                            : fmt::format("must be a list of {} to {} numbers", fewest, most));
      std::vector<double>& row = result.emplace_back();
      for (const YAML::Node& element : node[i]) row.push_back(checked(name, element, low, high));
    }
    return result;
  }

  bool is_list(const std::string& key) const { return has(key) && node_[key].IsSequence(); }
  bool is_text(const std::string& key) const { return has(key) && node_[key].IsScalar(); }

  /// Lets a key be there that is of no use here.
  void ignore(const std::string& key) { taken_.insert(key); }

  /// Throws Error about an element of the list under a key.
  [[noreturn]] void refuse_element(const std::string& key, std::size_t index, const std::string& rule) const {
    fail(fmt::format("{}[{}]", key, index), node_[key][index], rule);
  }

  /// Throws Error about the value of a key that is there.
  [[noreturn]] void refuse(const std::string& key, const std::string& rule) const {
    fail(key, node_[key], rule);
  }

  YamlSection section(const std::string& key) { return {take(key), path_, full(key)}; }

  /// A list of sections; at least one.
  std::vector<YamlSection> sections(const std::string& key) {
    const YAML::Node node = take(key);
    if (!node.IsSequence() || node.size() == 0) fail(key, node, "must be a list of at least one");
    std::vector<YamlSection> result;
    for (std::size_t i = 0; i < node.size(); ++i)
      result.push_back({node[i], path_, fmt::format("{}[{}]", full(key), i)});
    return result;
  }

  /// Throws Error for a key that nobody asked for.
  void finish() const {
    for (const auto& entry : node_)
      if (taken_.count(entry.first.Scalar()) == 0)
        throw Error(fmt::format("{}:{}: unknown key '{}'", path_, entry.first.Mark().line + 1,
                                full(entry.first.Scalar())));
  }

 private:
  YamlSection(const YAML::Node& node, std::string path, std::string name)
      : node_(node), path_(std::move(path)), name_(std::move(name)) {
    if (!node_.IsMap())
      throw Error(fmt::format("{}:{}: {} must be a section of 'key: value' lines", path_,
                              std::max(node_.Mark().line, 0) + 1, name_.empty() ? "the file" : name_));
  }

  std::string full(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }

  YAML::Node take(const std::string& key) {
    taken_.insert(key);
    const YAML::Node node = const_cast<const YAML::Node&>(node_)[key];
    if (!node) throw Error(fmt::format("{}: there is no key '{}'", path_, full(key)));
    return node;
  }

  double checked(const std::string& key, const YAML::Node& node, double low, double high) const {
    double value = 0;
    try {
      value = node.as<double>();
    } catch (const YAML::Exception&) {
      fail(key, node, "must be a number");
    }
    if (value >= low && value <= high) return value;
    if (low == std::numeric_limits<double>::min()) fail(key, node, "must be positive");
    fail(key, node, fmt::format("must be from {:g} to {:g}", low, high));
  }

  [[noreturn]] void fail(const std::string& key, const YAML::Node& node, const std::string& rule) const {
    throw Error(
        fmt::format("{}:{}: {} is {}, {}", path_, node.Mark().line + 1, full(key), shown(node), rule));
  }

  /// A value as an error tells it: in one line, and not too long.
  static std::string shown(const YAML::Node& node) {
    if (node.IsScalar()) return fmt::format("'{}'", node.Scalar());
    YAML::Emitter text;
    text << YAML::Flow << node;
    constexpr std::size_t longest = 60;
    const std::string list = text.c_str();
    return list.size() > longest || list.find('\n') != std::string::npos ? "not a single value" : list;
  }

  YAML::Node node_;
  std::string path_;
  std::string name_;
  std::set<std::string> taken_;
};

}  // namespace aeolian
