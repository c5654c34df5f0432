#pragma once

#include <string>
#include <vector>

#include "aeolian_twin/nodes/parameters.hpp"
#include "aeolian_twin/nodes/sensor_settings.hpp"

namespace aeolian {

/// config/twin.yaml: the topics of a bag, and for each node its parameters as the node knows them.
struct ReplayConfig {
  struct Topics {
    std::string points = "/points";
    std::string wind = "/wind";
    std::string wind_ahead = "/wind_ahead";
    std::string tf = "/tf";
    std::string tf_static = "/tf_static";
  };

  Topics topics;
  Parameters height_mapper;
  Parameters wind_estimator;
  Parameters forecaster;
  Parameters comparator;
  std::vector<SensorSettings> sensors;  ///< each with its topic
  SensorNoise noise;                    ///< of the map that no sensor has seen yet
  std::string text;                     ///< of the file
  std::vector<std::string> files;       ///< that the parameters name

  /// Throws Error in one line for a file that cannot be read, a section, topic or parameter that nobody
  /// knows, and as the node does for a value that is not allowed.
  static ReplayConfig read(const std::string& path);
};

}  // namespace aeolian
