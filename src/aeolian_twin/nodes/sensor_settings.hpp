#pragma once

#include <optional>
#include <string>
#include <vector>

#include <XmlRpcValue.h>
#include <ros/duration.h>

#include "aeolian_core/measure/registration.hpp"
#include "aeolian_core/measure/sensor_noise.hpp"
#include "aeolian_twin/nodes/parameters.hpp"

namespace aeolian {

/// What a node must know of one range sensor.
struct SensorSettings {
  std::string name;   ///< in diagnostics; empty: the only one
  std::string topic;  ///< of its clouds
  SensorNoise noise;
  ros::Duration latency;                               ///< how long after its measurement a cloud is stamped
  std::optional<RegistrationParameters> registration;  ///< of its clouds onto the map; nothing: none

  /// A thing of this sensor's ("clouds") as diagnostics call it.
  std::string thing(const std::string& what) const { return name.empty() ? what : name + " " + what; }
};

/// The parameters of a sensor, with what `shared` says as fallback; all but `topic`.
std::vector<ParameterDeclaration> sensor_parameters(const SensorSettings& shared);
/// The sensor that such parameters describe. Throws Error for those that do not fit together.
SensorSettings read_sensor(const Parameters& parameters, const std::string& name, const std::string& topic);
/// The sensors that the struct `sensors` among the values of a node's parameters names: NAME: {topic: ...,
/// sensor_file: ...}; what one leaves out is as in `shared`, its topic is NAME/points. Without that struct:
/// `shared` alone.
std::vector<SensorSettings> read_sensors(const std::string& node, const XmlRpc::XmlRpcValue& values,
                                         const SensorSettings& shared);

}  // namespace aeolian
