#pragma once

#include <functional>
#include <optional>

#include <grid_map_msgs/GridMap.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>
#include <visualization_msgs/Marker.h>

namespace aeolian {

/// Publishes the crests of a map on `crests` while somebody looks, and when the map has changed only. One who
/// starts to look gets the last ones. Listens to `wind_field` meanwhile: crests lie across the wind.
class CrestPublisher {
 public:
  /// Of the map as it is, for a wind that blows to a direction [rad]; nothing when that cannot be had.
  using Draw = std::function<std::optional<visualization_msgs::Marker>(double direction)>;

  /// `direction` [rad] counts until the wind is known; drawings are at least `period` [s] apart.
  CrestPublisher(ros::NodeHandle& node, double direction, double period, Draw draw);
  CrestPublisher(const CrestPublisher&) = delete;
  CrestPublisher& operator=(const CrestPublisher&) = delete;

  /// The map has changed.
  void note_change();

 private:
  void follow_wind();
  void take_wind(const grid_map_msgs::GridMap& message);
  void draw_when_due();
  void draw();

  ros::NodeHandle node_;
  double direction_;
  ros::WallDuration period_;
  Draw draw_;
  std::optional<visualization_msgs::Marker> drawn_;  ///< of the map as it is
  double drawn_direction_ = 0;
  ros::WallTime drawn_at_;
  ros::WallTimer due_;
  ros::Publisher publisher_;
  ros::Subscriber wind_subscriber_;
};

}  // namespace aeolian
