#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <message_filters/subscriber.h>
#include <ros/node_handle.h>
#include <sensor_msgs/PointCloud2.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/message_filter.h>

#include "aeolian_core/measure/registration.hpp"
#include "aeolian_core/measure/sensor_noise.hpp"
#include "aeolian_core/surface/point_cloud.hpp"
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
/// The sensors that the struct `sensors` of a node's parameters names: NAME: {topic: ..., sensor_file: ...};
/// what one leaves out is as in `shared`, its topic is NAME/points. Without that struct: `shared` alone.
std::vector<SensorSettings> read_sensors(const std::string& node, const SensorSettings& shared);

/// The clouds of one sensor, each with the pose that tf gives for when it was measured. What is amiss is
/// told, and the next cloud is waited for.
class CloudInput {
 public:
  /// Takes a cloud, the pose that brings it to the map's frame and when it was measured; throws Error for one
  /// that it cannot use.
  using Use = std::function<void(const PointCloud& cloud, const Eigen::Isometry3d& pose,
                                 const ros::Time& measured, const SensorSettings& sensor)>;
  /// Says how a thing ("clouds", "transform", "clock") is.
  using Tell = std::function<void(const std::string& thing, bool well, const std::string& line)>;

  struct Frames {
    tf2_ros::Buffer& buffer;
    std::string map;             ///< where clouds are brought to
    ros::WallDuration patience;  ///< a transform that is missing for so long is told of
    std::uint32_t queue_size;    ///< clouds that may wait for theirs
  };

  CloudInput(ros::NodeHandle& node, const SensorSettings& sensor, const Frames& frames, Use use, Tell tell);
  CloudInput(const CloudInput&) = delete;
  CloudInput& operator=(const CloudInput&) = delete;

  /// To be called now and then: tells of a transform that does not come.
  void watch();

 private:
  using PointCloud2 = sensor_msgs::PointCloud2;

  void arrived(const PointCloud2::ConstPtr& cloud);
  void take(const PointCloud2::ConstPtr& cloud);
  void dropped(const PointCloud2& cloud);
  void tell_of_transform(const std_msgs::Header& header);
  void tell(const std::string& thing, bool well, const std::string& line);

  SensorSettings sensor_;
  Frames frames_;
  Use use_;
  Tell tell_;
  message_filters::Subscriber<PointCloud2> subscriber_;
  tf2_ros::MessageFilter<PointCloud2> filter_;
  int waiting_ = 0;  ///< clouds whose transform is not known yet
  ros::WallTime waiting_since_;
  std_msgs::Header waiting_header_;  ///< of the newest of them
  ros::Time newest_arrived_;
};

}  // namespace aeolian
