#include "aeolian_twin/nodes/parameters.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

using XmlRpc::XmlRpcValue;

std::string as_given(const XmlRpcValue& given) {
  if (given.getType() == XmlRpcValue::TypeBoolean) return static_cast<const bool&>(given) ? "true" : "false";
  if (given.getType() == XmlRpcValue::TypeDouble) return fmt::format("{}", static_cast<const double&>(given));
  if (given.getType() == XmlRpcValue::TypeString) return "'" + static_cast<const std::string&>(given) + "'";
  std::ostringstream out;
  given.write(out);
  return out.str();
}

std::optional<double> as_number(const XmlRpcValue& given) {
  if (given.getType() == XmlRpcValue::TypeInt) return static_cast<const int&>(given);
  if (given.getType() == XmlRpcValue::TypeDouble) return static_cast<const double&>(given);
  return std::nullopt;
}

std::optional<std::vector<double>> as_numbers(const XmlRpcValue& given) {
  if (given.getType() != XmlRpcValue::TypeArray) return std::nullopt;
  std::vector<double> result;
  for (int i = 0; i < given.size(); ++i) {  // NOLINT(modernize-loop-convert): begin() is for structs only
    const std::optional<double> number = as_number(given[i]);
    if (!number) return std::nullopt;
    result.push_back(*number);
  }
  return result;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

/// What a value must be, for an error message.
std::string allowed(const ParameterDeclaration& declared) {
  struct {
    const ParameterDeclaration& d;
    std::string operator()(bool) const { return "true or false"; }
    std::string operator()(int) const { return "a whole number" + d.limits.text(); }
    std::string operator()(double) const { return "a number" + d.limits.text(); }
    std::string operator()(const std::string&) const {
      return d.choices.empty() ? "a text" : "one of " + joined(d.choices);
    }
    std::string operator()(const std::vector<double>&) const { return "a list of numbers" + d.limits.text(); }
  } describe{declared};
  return std::visit(describe, declared.fallback) + (declared.unit.empty() ? "" : " [" + declared.unit + "]");
}

/// The given value as the kind of the declared default, nothing when it is not one or not allowed.
struct Accept {
  const ParameterDeclaration& declared;
  const XmlRpcValue& given;

  std::optional<ParameterValue> operator()(bool) const {
    if (given.getType() != XmlRpcValue::TypeBoolean) return std::nullopt;
    return static_cast<const bool&>(given);
  }
  std::optional<ParameterValue> operator()(int) const {
    if (given.getType() != XmlRpcValue::TypeInt) return std::nullopt;
    const int number = static_cast<const int&>(given);
    if (!declared.limits.allow(number)) return std::nullopt;
    return number;
  }
  std::optional<ParameterValue> operator()(double) const {
    const std::optional<double> number = as_number(given);
    if (!number || !declared.limits.allow(*number)) return std::nullopt;
    return *number;
  }
  std::optional<ParameterValue> operator()(const std::string&) const {
    if (given.getType() != XmlRpcValue::TypeString) return std::nullopt;
    const auto& text = static_cast<const std::string&>(given);
    const auto& choices = declared.choices;
    if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end())
      return std::nullopt;
    return text;
  }
  std::optional<ParameterValue> operator()(const std::vector<double>&) const {
    const std::optional<std::vector<double>> list = as_numbers(given);
    if (!list) return std::nullopt;
    const auto ok = [&](double v) { return declared.limits.allow(v); };
    if (!std::all_of(list->begin(), list->end(), ok)) return std::nullopt;
    return *list;
  }
};

}  // namespace

bool Limits::allow(double value) const {
  return std::isfinite(value) && value <= high && (low_is_allowed ? value >= low : value > low);
}

std::string Limits::text() const {
  const std::string above = low_is_allowed ? " of at least " : " above ";
  if (std::isfinite(low) && std::isfinite(high))
    return low_is_allowed ? fmt::format(" from {} to {}", low, high)
                          : fmt::format(" above {}, up to {}", low, high);
  if (std::isfinite(low)) return above + fmt::format("{}", low);
  if (std::isfinite(high)) return fmt::format(" of at most {}", high);
  return "";
}

Parameters::Parameters(const std::vector<ParameterDeclaration>& declarations, const std::string& prefix,
                       const XmlRpcValue& values)
    : prefix_(prefix) {
  const bool has_any = values.getType() == XmlRpcValue::TypeStruct;
  for (const ParameterDeclaration& declared : declarations) {
    if (!has_any || !values.hasMember(declared.name)) {
      values_.emplace_back(declared.name, declared.fallback);
      continue;
    }
    const XmlRpcValue& given = values[declared.name];
    const std::optional<ParameterValue> accepted = std::visit(Accept{declared, given}, declared.fallback);
    if (!accepted)
      throw Error(fmt::format("{}/{}: {} is not allowed, must be {}", prefix, declared.name, as_given(given),
                              allowed(declared)));
    values_.emplace_back(declared.name, *accepted);
  }
  if (!has_any) return;
  for (const auto& [name, given] : values) {
    const auto same = [&, &key = name](const ParameterDeclaration& d) { return d.name == key; };
    if (given.getType() != XmlRpcValue::TypeStruct &&
        std::none_of(declarations.begin(), declarations.end(), same))
      unknown_.push_back(name);
  }
}

const ParameterValue& Parameters::value(const std::string& name) const {
  for (const auto& entry : values_)
    if (entry.first == name) return entry.second;
  throw std::logic_error(prefix_ + "/" + name + " is not declared");
}

bool Parameters::flag(const std::string& name) const { return std::get<bool>(value(name)); }
int Parameters::integer(const std::string& name) const { return std::get<int>(value(name)); }
double Parameters::number(const std::string& name) const { return std::get<double>(value(name)); }
const std::string& Parameters::text(const std::string& name) const {
  return std::get<std::string>(value(name));
}
const std::vector<double>& Parameters::numbers(const std::string& name) const {
  return std::get<std::vector<double>>(value(name));
}

void Parameters::refuse(const std::string& name, const std::string& must_be) const {
  throw Error(
      fmt::format("{}/{}: {} is not allowed, must be {}", prefix_, name, to_text(value(name)), must_be));
}

std::string to_text(const ParameterValue& value) {
  struct {
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(int v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return fmt::format("{}", v); }
    std::string operator()(const std::string& v) const { return "'" + v + "'"; }
    std::string operator()(const std::vector<double>& v) const {
      return fmt::format("[{}]", fmt::join(v, ", "));
    }
  } text;
  return std::visit(text, value);
}

}  // namespace aeolian
