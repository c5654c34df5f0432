#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <geometry_msgs/TwistStamped.h>
#include <pluginlib/class_list_macros.hpp>
#include <tf2_eigen/tf2_eigen.h>
#include <tf2_ros/buffer.h>
#include <tf2_ros/transform_listener.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/log_law.hpp"
#include "aeolian_core/wind/wind_model.hpp"
#include "aeolian_twin/nodes/conversions.hpp"
#include "aeolian_twin/nodes/node.hpp"

namespace aeolian {

/// An anemometer's readings to the wind that the grains feel.
class WindEstimator : public Node {
 public:
  WindEstimator() : Node(describe_wind_estimator()) {}

 private:
  void start() override {
    frame_ = parameters().text("frame_id");
    anemometer_height_ = parameters().number("anemometer_height");
    air_density_ = parameters().number("air_density");
    max_speed_ = parameters().number("max_speed");
    max_gap_ = parameters().number("max_gap");
    const double roughness = parameters().number("roughness");
    model_ = std::make_unique<LogLawWind>(
        roughness > 0 ? roughness : grain_roughness(parameters().number("grain_diameter")));
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
      map_ = to_height_map(*message);
      double sum = 0;
      const HeightMap::Layer& elevation = map_.layer(layer::elevation);
      for (const float z : elevation)
        if (std::isfinite(z)) sum += static_cast<double>(z);
      const std::size_t known = count_known(elevation);
      ground_ = known > 0 ? sum / static_cast<double>(known) : 0;
      good("map", "the ground is known");
    } catch (const Error& error) {
      bad("map", error.what());
    }
  }

  void take_wind(const geometry_msgs::TwistStamped::ConstPtr& message) {
    received_ = ros::WallTime::now();
    notice_time(message->header.stamp);
    try {
      publish(solve(*message), message->header.stamp);
    } catch (const Error& error) {
      bad("wind", error.what());
    }
  }

  WindField solve(const geometry_msgs::TwistStamped& message) {
    Eigen::Vector3d velocity(message.twist.linear.x, message.twist.linear.y, 0);
    if (!velocity.allFinite() || velocity.norm() > max_speed_)
      throw Error(
          fmt::format("{}: velocity is ({}, {}) m/s, must be finite and at most {} m/s (~max_speed); skipped",
                      wind_subscriber_.getTopic(), velocity.x(), velocity.y(), max_speed_));
    WindInput input;
    input.height = anemometer_height_;
    if (const std::optional<Eigen::Isometry3d> mast = anemometer_pose(message.header)) {
      velocity = mast->linear() * velocity;
      input.height = mast->translation().z() - ground_;
    }
    input.speed = velocity.head<2>().norm();
    input.direction = std::atan2(velocity.y(), velocity.x());
    input.air_density = air_density_;
    const bool has_map = map_.geometry().size() > 0;
    WindField wind = model_->solve(input, has_map ? &map_ : nullptr);
    good("wind", fmt::format("{:.2f} m/s at {:.2f} m over the ground gives a friction velocity of {:.3f} m/s",
                             input.speed, input.height, wind.friction_velocity));
    return wind;
  }

  /// Where the anemometer stands; nothing when tf does not know, then its parameters hold.
  std::optional<Eigen::Isometry3d> anemometer_pose(const std_msgs::Header& header) const {
    if (header.frame_id.empty() || header.frame_id == frame_) return std::nullopt;
    if (!tf_buffer_.canTransform(frame_, header.frame_id, ros::Time(0))) return std::nullopt;
    return tf2::transformToEigen(tf_buffer_.lookupTransform(frame_, header.frame_id, ros::Time(0)));
  }

  void publish(const WindField& wind, const ros::Time& stamp) {
    std_msgs::Header header;
    header.frame_id = frame_;
    header.stamp = stamp;
    const GridGeometry one_cell(-0.5, -0.5, 1, 1, 1);
    publisher_.publish(to_message(wind, map_.geometry().size() > 0 ? map_.geometry() : one_cell, header));
  }

  void notice_time(const ros::Time& stamp) {
    const double step = last_stamp_.isZero() ? 0 : (stamp - last_stamp_).toSec();
    if (step < 0)
      bad("clock", fmt::format("time jumped back by {:.1f} s (a bag that loops?)", -step));
    else if (step > max_gap_)
      bad("clock",
          fmt::format("the wind record has a gap of {:.1f} s, more than ~max_gap = {} s", step, max_gap_));
    else
      good("clock", "no gaps");
    last_stamp_ = stamp;
  }

  std::string frame_;
  double anemometer_height_ = 0;
  double air_density_ = 0;
  double max_speed_ = 0;
  double max_gap_ = 0;
  std::unique_ptr<WindModel> model_;
  HeightMap map_;
  double ground_ = 0;  ///< mean elevation of the map [m]
  ros::WallTime received_;
  ros::Time last_stamp_;
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
