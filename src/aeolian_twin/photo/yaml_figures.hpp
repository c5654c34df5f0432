#pragma once

#include <cmath>
#include <string>

#include <fmt/chrono.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/measure/shadow_profile.hpp"

namespace aeolian {

/// Digits enough for any figure, and few enough to be read.
constexpr int summary_digits = 6;

template <class Value>
void put(YAML::Emitter& out, const std::string& key, const Value& value) {
  out << YAML::Key << key << YAML::Value << value;
}

/// Puts NAME_UNIT and sigma_NAME_UNIT; the figure is told times `factor`.
inline void put_figure(YAML::Emitter& out, const std::string& name, const std::string& unit,
                       const Figure& figure, double factor) {
  const std::string key = unit.empty() ? name : name + "_" + unit;
  put(out, key, factor * figure.value);
  put(out, "sigma_" + key, std::abs(factor) * figure.sigma);
}

inline std::string utc_text(double unix_time) {
  return fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(static_cast<std::time_t>(unix_time)));
}

}  // namespace aeolian
