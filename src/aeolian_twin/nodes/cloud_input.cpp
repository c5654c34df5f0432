#include "aeolian_twin/nodes/cloud_input.hpp"

#include <fmt/format.h>
#include <ros/param.h>
#include <tf2_eigen/tf2_eigen.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
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

std::vector<SensorSettings> read_sensors(const std::string& node, const SensorSettings& shared) {
  XmlRpc::XmlRpcValue sensors;
  const std::string where = node + "/sensors";
  if (!ros::param::get(where, sensors)) return {shared};
  if (sensors.getType() != XmlRpc::XmlRpcValue::TypeStruct || sensors.size() == 0)
    throw Error(where + " must name sensors: {NAME: {topic: TOPIC, sensor_file: FILE}}");
  std::vector<SensorSettings> result;
  for (const auto& [name, values] : sensors) {
    std::vector<ParameterDeclaration> declared = sensor_parameters(shared);
    declared.push_back({"topic", name + "/points", "", "of its clouds"});
    const Parameters parameters(declared, where + "/" + name, values);
    if (values.getType() != XmlRpc::XmlRpcValue::TypeStruct)
      throw Error(where + "/" + name + " must be parameters of a sensor: {topic: TOPIC, sensor_file: FILE}");
    if (!parameters.unknown().empty())
      throw Error(fmt::format("{}/{}/{}: there is no such parameter of a sensor", where, name,
                              parameters.unknown().front()));
    SensorSettings sensor = read_sensor(parameters, name, parameters.text("topic"));
    result.push_back(std::move(sensor));
  }
  return result;
}

CloudInput::CloudInput(ros::NodeHandle& node, const SensorSettings& sensor, const Frames& frames, Use use,
                       Tell tell)
    : sensor_(sensor),
      frames_(frames),
      use_(std::move(use)),
      tell_(std::move(tell)),
      filter_(frames.buffer, frames.map, frames.queue_size, node) {
  // In this order: every cloud is seen before it waits for its transform.
  subscriber_.registerCallback(&CloudInput::arrived, this);
  filter_.connectInput(subscriber_);
  filter_.registerCallback(&CloudInput::take, this);
  filter_.registerFailureCallback([this](const PointCloud2::ConstPtr& cloud, auto) { dropped(*cloud); });
  subscriber_.subscribe(node, sensor.topic, frames.queue_size);
  this->tell("clouds", false, "no cloud has arrived on " + subscriber_.getTopic());
}

void CloudInput::tell(const std::string& thing, bool well, const std::string& line) {
  tell_(sensor_.thing(thing), well, line);
}

void CloudInput::watch() {
  if (waiting_ > 0 && ros::WallTime::now() - waiting_since_ > frames_.patience)
    tell_of_transform(waiting_header_);
}

void CloudInput::arrived(const PointCloud2::ConstPtr& cloud) {
  if (waiting_++ == 0) waiting_since_ = ros::WallTime::now();
  waiting_header_ = cloud->header;
  const ros::Time stamp = cloud->header.stamp;
  if (stamp < newest_arrived_) {
    tell("clock", false,
         fmt::format("time jumped back by {:.1f} s (a bag that loops?), the map is kept",
                     (newest_arrived_ - stamp).toSec()));
    // Transforms of the time before the jump would make tf refuse the new ones as too old.
    if (!frames_.buffer.canTransform(frames_.map, cloud->header.frame_id, stamp)) {
      filter_.clear();
      frames_.buffer.clear();
      waiting_ = 1;
    }
  } else if (!newest_arrived_.isZero()) {
    tell("clock", true, "time runs forward");
  }
  newest_arrived_ = stamp;
}

void CloudInput::dropped(const PointCloud2& cloud) {
  if (waiting_ > 0) --waiting_;
  tell_of_transform(cloud.header);
}

void CloudInput::tell_of_transform(const std_msgs::Header& header) {
  std::string reason = "the cloud's frame_id is empty";
  if (!header.frame_id.empty())
    frames_.buffer.canTransform(frames_.map, header.frame_id, header.stamp, &reason);
  tell("transform", false,
       fmt::format("no transform from '{}' to '{}': {}", header.frame_id, frames_.map, reason));
}

void CloudInput::take(const PointCloud2::ConstPtr& message) {
  waiting_ = 0;
  const std::string& frame = message->header.frame_id;
  try {
    // A time of zero would ask tf for its newest.
    const ros::Time stamp = message->header.stamp;
    const bool early = stamp - ros::Time(0) <= sensor_.latency;
    const ros::Time measured = early ? stamp : stamp - sensor_.latency;
    const Eigen::Isometry3d pose =
        tf2::transformToEigen(frames_.buffer.lookupTransform(frames_.map, frame, measured));
    tell("transform", true, fmt::format("from '{}' to '{}' is known", frame, frames_.map));
    use_(to_point_cloud(*message), pose, measured, sensor_);
  } catch (const tf2::TransformException& error) {
    tell("transform", false, error.what());
  } catch (const Error& error) {
    tell("clouds", false, subscriber_.getTopic() + ": " + error.what());
  }
}

}  // namespace aeolian
