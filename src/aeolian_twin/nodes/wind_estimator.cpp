#include <memory>
#include <optional>

#include <fmt/format.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_ros/buffer.h>

#include "aeolian_twin/nodes/map_receiver.hpp"
#include "aeolian_twin/nodes/node.hpp"
#include "aeolian_twin/nodes/transform_input.hpp"
#include "aeolian_twin/nodes/wind_probes.hpp"
#include "aeolian_twin/nodes/wind_reader.hpp"

namespace aeolian {

/// Readings of anemometers to the wind that the grains feel: WindReader on topics, and the wind at points.
class WindEstimator : public Node {
 public:
  WindEstimator() : Node(describe_wind_estimator()) {}

 private:
  void start() override {
    max_gap_ = parameters().number("max_gap");
    const Tell tell = [this](const std::string& thing, bool well, const std::string& line) {
      well ? good(thing, line) : bad(thing, line);
    };
    reader_ = std::make_unique<WindReader>(parameters(), nh().resolveName("wind"), tf_buffer_, tell);
    publisher_ = nh().advertise<grid_map_msgs::GridMap>("wind_field", 100);
    statistics_publisher_ = nh().advertise<aeolian_msgs::WindStatistics>("wind_statistics", 100);
    transforms_ = std::make_unique<TransformInput>(tf_buffer_);
    probes_ = std::make_unique<WindProbes>(nh(), *reader_, parameters().text("frame_id"), tf_buffer_, tell);
    WantedMap wanted;
    wanted.layers = {layer::elevation};
    wanted.accept = [this](const std::string& topic, const std_msgs::Header& header) {
      require_frame(topic, header);
    };
    receiver_ = std::make_unique<MapReceiver>(
        nh(), "height_map",
        [this](const HeightMap& map, const std_msgs::Header&, const TileMask& changed) {
          if (!changed.empty()) reader_->take_map(map);
          good("map", "the ground is known");
        },
        [this](const std::string& reason) { bad("map", reason); }, wanted);
    wind_subscriber_ = nh().subscribe("wind", 100, &WindEstimator::take_wind, this);
    received_ = ros::WallTime::now();
  }

  void watch() override {
    const double silence = (ros::WallTime::now() - received_).toSec();
    if (silence > max_gap_)
      bad("wind",
          fmt::format("nothing has arrived on {} for {:.0f} s", wind_subscriber_.getTopic(), silence));
  }

  void take_wind(const geometry_msgs::TwistStamped::ConstPtr& message) {
    received_ = ros::WallTime::now();
    const auto wind = reader_->take_wind(*message);
    if (!wind) return;
    publisher_.publish(*wind);
    if (statistics_publisher_.getNumSubscribers() > 0) statistics_publisher_.publish(reader_->statistics());
    probes_->note_wind();
  }

  double max_gap_ = 0;
  std::unique_ptr<WindReader> reader_;
  ros::WallTime received_;
  tf2_ros::Buffer tf_buffer_;
  std::unique_ptr<TransformInput> transforms_;
  std::unique_ptr<WindProbes> probes_;
  std::unique_ptr<MapReceiver> receiver_;
  ros::Publisher publisher_;
  ros::Publisher statistics_publisher_;
  ros::Subscriber wind_subscriber_;
};

NodeDescription describe_wind_estimator() {
  const WindInput wind;
  return {
      "wind_estimator",
      "turns readings of one or several anemometers into the wind at the surface and in the air above",
      {"wind (geometry_msgs/TwistStamped): linear.x, linear.y is the velocity [m/s] in the message's frame; "
       "each anemometer has a frame of its own, whose place tf may know",
       "height_map, height_map_updates (grid_map_msgs/GridMap): whole, what has changed",
       "probes (geometry_msgs/PoseArray): points at which the wind is wanted"},
      {"wind_field (grid_map_msgs/GridMap): friction_velocity [m/s], direction [rad], air_density [kg/m^3]; "
       "one cell for a uniform wind; of one that varies also separated, speed_up, elevation [m]",
       "wind_statistics (aeolian_msgs/WindStatistics): model and age of the field, gusts of the anemometers",
       "probe_wind (aeolian_msgs/WindAtPoints): velocity, lift, turbulence at the probes",
       "probe_wind (aeolian_msgs/ProbeWind, a service): the same for points asked for, and gusts there"},
      {
          frame_parameter(),
          {"anemometer_height", wind.height, "m",
           "over the ground, where tf does not know the anemometer's frame", Limits::positive()},
          {"grain_diameter", 0.00025, "m", "of the bed: roughness is a thirtieth of it", Limits::positive()},
          {"roughness", 0.0, "m", "aerodynamic roughness length; 0: from the grain diameter",
           Limits::not_negative()},
          {"air_density", wind.air_density, "kg/m^3", "of the air", Limits::positive()},
          {"max_speed", 60.0, "m/s", "a faster reading is skipped as absurd", Limits::positive()},
          {"max_gap", 5.0, "s", "a longer time without a reading is reported, and an anemometer not used",
           Limits::positive()},
          {"averaging_time", 0.0, "s", "readings are averaged over so long; 0: each by itself",
           Limits::not_negative()},
          {"statistics_window", 600.0, "s", "gust statistics are those of so long", Limits::positive()},
          {"model",
           std::string("auto"),
           "",
           "of the wind over the map; auto: what suits its relief",
           Limits::any(),
           {"auto", "log", "spectral", "mass_consistent"}},
      },
      [] { return std::make_shared<WindEstimator>(); }};
}

}  // namespace aeolian

PLUGINLIB_EXPORT_CLASS(aeolian::WindEstimator, nodelet::Nodelet)
