#pragma once

#include <string>

#include "aeolian_core/measure/sensor_noise.hpp"

namespace aeolian {

/// A range sensor as a file of config/sensors/ describes it.
struct SensorFile {
  std::string name;
  SensorNoise noise;
};

/// Reads such a file; throws Error naming file, line, key and what is allowed.
SensorFile read_sensor_file(const std::string& path);

}  // namespace aeolian
