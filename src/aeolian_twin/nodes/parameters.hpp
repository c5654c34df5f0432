#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include <XmlRpcValue.h>

namespace aeolian {

/// Which numbers a parameter may be.
struct Limits {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_is_allowed = true;

  static Limits any() { return {}; }
  static Limits positive() { return {0, std::numeric_limits<double>::infinity(), false}; }
  static Limits not_negative() { return {0, std::numeric_limits<double>::infinity(), true}; }
  static Limits between(double low, double high) { return {low, high, true}; }

  bool allow(double value) const;
  std::string text() const;
};

using ParameterValue = std::variant<bool, int, double, std::string, std::vector<double>>;

/// One parameter of a node: everything that its check, its help and its place in a YAML file need. The kind
/// of the default is the kind of the parameter; limits hold for each number of a list.
struct ParameterDeclaration {
  std::string name;
  ParameterValue fallback;
  std::string unit;  ///< empty when there is none
  std::string help;  ///< one line
  Limits limits = Limits::any();
  std::vector<std::string> choices = {};  ///< of a string; empty: any
};

/// A node's parameters, checked once at start-up.
class Parameters {
 public:
  /// `values` is the node's private namespace as the parameter server holds it, `prefix` its name
  /// ("/height_mapper"). Throws Error naming parameter, value and what is allowed.
  Parameters(const std::vector<ParameterDeclaration>& declarations, const std::string& prefix,
             const XmlRpc::XmlRpcValue& values);

  bool flag(const std::string& name) const;
  int integer(const std::string& name) const;
  double number(const std::string& name) const;
  const std::string& text(const std::string& name) const;
  const std::vector<double>& numbers(const std::string& name) const;

  /// Names in the namespace that no declaration knows: most likely misspelt.
  const std::vector<std::string>& unknown() const { return unknown_; }

  /// An Error for a parameter whose value is bad beside others: "/height_mapper/min_x: 3 ... must be ...".
  [[noreturn]] void refuse(const std::string& name, const std::string& must_be) const;

 private:
  const ParameterValue& value(const std::string& name) const;

  std::string prefix_;
  std::vector<std::pair<std::string, ParameterValue>> values_;
  std::vector<std::string> unknown_;
};

/// The value as a YAML scalar or list.
std::string to_text(const ParameterValue& value);

}  // namespace aeolian
