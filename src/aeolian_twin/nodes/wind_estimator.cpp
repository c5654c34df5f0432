#include <memory>
#include <optional>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/wind_reader.hpp"

namespace aeolian {

/// An anemometer's readings to the wind that the grains feel: WindReader on topics.
class WindEstimator : public Node {
 public:
  WindEstimator() : Node(describe_wind_estimator()) {}

 private:
  void start() override {
    max_gap_ = parameters().number("max_gap");
    reader_ =
        std::make_unique<WindReader>(parameters(), nh().resolveName("wind"), tf_buffer_,
                                     [this](const std::string& thing, bool well, const std::string& line) {
                                       well ? good(thing, line) : bad(thing, line);
                                     });
    publisher_ = nh().advertise<grid_map_msgs::GridMap>("wind_field", 100);
    listener_ = std::make_unique<tf2_ros::TransformListener>(tf_buffer_);
    map_subscriber_ = nh().subscribe("height_map", 1, &WindEstimator::take_map, this);
    wind_subscriber_ = nh().subscribe("wind", 100, &WindEstimator::take_wind, this);
    received_ = ros::WallTime::now();
  }

  void watch() override {
    const double silence = (ros::WallTime::now() - received_).toSec();
    if (silence > max_gap_)
      bad("wind",
          fmt::format("nothing has arrived on {} for {:.0f} s", wind_subscriber_.getTopic(), silence));
  }

  void take_map(const grid_map_msgs::GridMap::ConstPtr& message) {
    try {
      require_frame(map_subscriber_.getTopic(), message->info.header);
      reader_->take_map(*message);
      good("map", "the ground is known");
    } catch (const Error& error) {
      bad("map", error.what());
    }
  }

  void take_wind(const geometry_msgs::TwistStamped::ConstPtr& message) {
    received_ = ros::WallTime::now();
    if (const auto wind = reader_->take_wind(*message)) publisher_.publish(*wind);
  }

  double max_gap_ = 0;
  std::unique_ptr<WindReader> reader_;
  ros::WallTime received_;
  tf2_ros::Buffer tf_buffer_;
  std::unique_ptr<tf2_ros::TransformListener> listener_;
  ros::Publisher publisher_;
  ros::Subscriber map_subscriber_;
  ros::Subscriber wind_subscriber_;
};

NodeDescription describe_wind_estimator() {
  const WindInput wind;
  return {
      "wind_estimator",
      "turns an anemometer's readings into the wind at the surface",
      {"wind (geometry_msgs/TwistStamped): linear.x, linear.y is the velocity [m/s] in the message's frame",
       "height_map (grid_map_msgs/GridMap)"},
      {"wind_field (grid_map_msgs/GridMap): friction_velocity [m/s], direction [rad], air_density [kg/m^3]; "
       "one cell for "
       "a uniform wind"},
      {
          frame_parameter(),
          {"anemometer_height", wind.height, "m",
           "over the ground, where tf does not know the anemometer's frame", Limits::positive()},
          {"grain_diameter", 0.00025, "m", "of the bed: roughness is a thirtieth of it", Limits::positive()},
          {"roughness", 0.0, "m", "aerodynamic roughness length; 0: from the grain diameter",
           Limits::not_negative()},
          {"air_density", wind.air_density, "kg/m^3", "of the air", Limits::positive()},
          {"max_speed", 60.0, "m/s", "a faster reading is skipped as absurd", Limits::positive()},
          {"max_gap", 5.0, "s", "a longer time without a reading is reported", Limits::positive()},
      },
      [] { return std::make_shared<WindEstimator>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::WindEstimator, nodelet::Nodelet)
