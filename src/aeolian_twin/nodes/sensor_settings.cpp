#include "aeolian_twin/nodes/sensor_settings.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/sensor_file.hpp"

namespace aeolian {
namespace {

std::string method_name(const std::optional<RegistrationParameters>& registration) {
  if (!registration) return "none";
  return registration->method == RegistrationMethod::icp ? "icp" : "ndt";
}

}  // namespace

std::vector<ParameterDeclaration> sensor_parameters(const SensorSettings& shared) {
  const SensorNoise& noise = shared.noise;
  const RegistrationParameters registration = shared.registration.value_or(RegistrationParameters());
  return {
      {"range_sigma", noise.range_sigma, "m", "noise of the sensor along the ray", Limits::positive()},
      {"range_sigma_per_metre", noise.range_sigma_per_metre, "m/m", "its growth with range",
       Limits::not_negative()},
      {"min_range", noise.min_range, "m", "nearer points are ignored", Limits::not_negative()},
      {"max_range", noise.max_range, "m", "farther points are ignored", Limits::positive()},
      {"sensor_file", std::string(), "",
       "file of config/sensors with the noise and the ranges of the sensor; empty: as said here"},
      {"latency", shared.latency.toSec(), "s", "how long after its measurement a cloud is stamped",
       Limits::between(0, 10)},
      {"registration",
       method_name(shared.registration),
       "",
       "how each cloud is refined against the map",
       Limits::any(),
       {"none", "icp", "ndt"}},
      {"max_shift", registration.max_shift, "m", "a refinement that moves a point farther is refused",
       Limits::positive()},
      {"max_angle_deg", shared.registration ? radians_to_degrees(registration.max_angle) : 2.0, "degrees",
       "a refinement that turns the cloud by more is refused", Limits::between(0, 45)},
  };
}

SensorSettings read_sensor(const Parameters& parameters, const std::string& name, const std::string& topic) {
  SensorSettings sensor;
  sensor.name = name;
  sensor.topic = topic;
  sensor.latency = ros::Duration(parameters.number("latency"));
  sensor.noise.range_sigma = parameters.number("range_sigma");
  sensor.noise.range_sigma_per_metre = parameters.number("range_sigma_per_metre");
  sensor.noise.min_range = parameters.number("min_range");
  sensor.noise.max_range = parameters.number("max_range");
  if (sensor.noise.min_range >= sensor.noise.max_range) parameters.refuse("min_range", "less than max_range");
  if (const std::string& method = parameters.text("registration"); method != "none") {
    RegistrationParameters registration;
    registration.method = method == "icp" ? RegistrationMethod::icp : RegistrationMethod::ndt;
    registration.max_shift = parameters.number("max_shift");
    registration.max_angle = degrees_to_radians(parameters.number("max_angle_deg"));
    sensor.registration = registration;
  }
  if (const std::string file = parameters.text("sensor_file"); !file.empty()) {
    const SensorNoise given = sensor.noise;
    sensor.noise = read_sensor_file(file).noise;
    sensor.noise.min_range = std::max(sensor.noise.min_range, given.min_range);
    sensor.noise.max_range = std::min(sensor.noise.max_range, given.max_range);
    if (sensor.noise.min_range >= sensor.noise.max_range)
      parameters.refuse("min_range", "less than the max_range of " + file);
  }
  return sensor;
}

std::vector<SensorSettings> read_sensors(const std::string& node, const XmlRpc::XmlRpcValue& values,
                                         const SensorSettings& shared) {
  const std::string where = node + "/sensors";
  if (values.getType() != XmlRpc::XmlRpcValue::TypeStruct || !values.hasMember("sensors")) return {shared};
  const XmlRpc::XmlRpcValue& sensors = values["sensors"];
  if (sensors.getType() != XmlRpc::XmlRpcValue::TypeStruct || sensors.size() == 0)
    throw Error(where + " must name sensors: {NAME: {topic: TOPIC, sensor_file: FILE}}");
  std::vector<SensorSettings> result;
  for (const auto& [name, own] : sensors) {
    std::vector<ParameterDeclaration> declared = sensor_parameters(shared);
    declared.push_back({"topic", name + "/points", "", "of its clouds"});
    const Parameters parameters(declared, where + "/" + name, own);
    if (own.getType() != XmlRpc::XmlRpcValue::TypeStruct)
      throw Error(where + "/" + name + " must be parameters of a sensor: {topic: TOPIC, sensor_file: FILE}");
    if (!parameters.unknown().empty())
      throw Error(fmt::format("{}/{}/{}: there is no such parameter of a sensor", where, name,
                              parameters.unknown().front()));
    SensorSettings sensor = read_sensor(parameters, name, parameters.text("topic"));
    result.push_back(std::move(sensor));
  }
  return result;
}

}  // namespace aeolian
