#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <aeolian_msgs/WindStatistics.h>
#include <geometry_msgs/TwistStamped.h>
#include <grid_map_msgs/GridMap.h>
#include <ros/time.h>
#include <tf2/buffer_core.h>

#include "aeolian_core/wind/terrain_wind.hpp"
#include "aeolian_twin/nodes/parameters.hpp"
#include "aeolian_twin/nodes/relative_clock.hpp"
#include "aeolian_twin/nodes/tell.hpp"
#include "aeolian_twin/nodes/wind_ground.hpp"
#include "aeolian_twin/nodes/wind_window.hpp"

namespace aeolian {

/// What wind_estimator makes of the readings of anemometers, each of which has a frame of its own. The node
/// and `replay` share it; it needs no master.
class WindReader {
 public:
  /// `topic` of the readings; `transforms` must outlive this.
  WindReader(const Parameters& parameters, const std::string& topic, const tf2::BufferCore& transforms,
             Tell tell);

  /// Takes the ground. Throws Error for what is no map.
  void take_map(const grid_map_msgs::GridMap& message);
  void take_map(const HeightMap& map) { ground_.take(map); }
  /// The wind field of a reading and of the latest of the other anemometers; nothing, and told, when there is
  /// none.
  std::optional<grid_map_msgs::GridMap> take_wind(const geometry_msgs::TwistStamped& message);

  /// The last field, once there is one.
  const std::optional<WindField>& field() const { return field_; }
  /// What it was made of. Only with a field.
  aeolian_msgs::WindStatistics statistics() const;

  const WindGround& ground() const { return ground_; }
  TerrainWind& model() { return model_; }
  double roughness() const { return roughness_; }
  /// Stamp and frame of the last field.
  std_msgs::Header header() const;
  /// The same stamp, in seconds since the first reading.
  double time() const { return time_; }

 private:
  struct Anemometer {
    Anemometer(std::string its_frame, double length) : frame(std::move(its_frame)), window(length) {}
    std::string frame;
    WindWindow window;
    std::optional<Eigen::Vector3d> place;  ///< nothing: in the surroundings
    std::string refused;                   ///< why it was not used
  };

  Anemometer& take_reading(const geometry_msgs::TwistStamped& message, double time);
  WindField solve(double now);
  WindField solve(const std::vector<Anemometer*>& used, double now);
  std::vector<Anemometer*> heard(double now);
  void keep_useful(std::vector<Anemometer*>& used, double now);
  bool refuse_sheltered(std::vector<Anemometer*>& used, const WindField& field);
  std::string refusals() const;
  WindInput input(const Anemometer& anemometer, double now) const;
  double height_over_ground(const Anemometer& anemometer) const;
  std::optional<Eigen::Isometry3d> anemometer_pose(const std_msgs::Header& header) const;
  void notice_time(const std::string& frame, double time);

  std::string topic_;
  const tf2::BufferCore& transforms_;
  Tell tell_;
  std::string frame_;
  double anemometer_height_;
  double air_density_;
  double max_speed_;
  double max_gap_;
  double averaging_time_;
  double window_;  ///< for how long readings are kept [s]
  double roughness_;
  TerrainWind model_;
  WindGround ground_;
  RelativeClock clock_;
  std::map<std::string, Anemometer> anemometers_;  ///< by frame
  std::map<std::string, double> heard_;            ///< when the last reading of a frame came, good or bad [s]
  std::optional<WindField> field_;
  ros::Time stamp_;  ///< of the field
  double time_ = 0;
};

}  // namespace aeolian
