#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>

#include <grid_map_msgs/GridMap.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/single_subscriber_publisher.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

/// Publishes what a map looks like in a wind (crests, which lie across it; arrows) while somebody looks, and
/// only when the map or the wind has changed. One who starts to look gets the last drawing. Listens to
/// `wind_field` meanwhile.
template <class Message>
class WindDrawing {
 public:
  struct What {
    std::string topic;
    double period = 0;              ///< drawings are at least so far apart [s]
    std::optional<WindField> wind;  ///< counts until it is known; nothing is drawn without
    /// Of the map as it is; nothing when that cannot be had.
    std::function<std::optional<Message>(const WindField& wind)> draw;
    /// Whether another wind makes another drawing.
    std::function<bool(const WindField& drawn, const WindField& now)> differs;
  };

  WindDrawing(ros::NodeHandle& node, What what)
      : node_(node), what_(std::move(what)), period_(what_.period), wind_(what_.wind) {
    due_ = node_.createWallTimer(
        period_, [this](const ros::WallTimerEvent&) { draw(); }, /*oneshot=*/true, /*autostart=*/false);
    using Looker = ros::SingleSubscriberPublisher;
    const auto looks = [this](const Looker& to) {
      follow_wind();
      if (drawn_)
        to.publish(*drawn_);
      else
        draw_when_due();
    };
    publisher_ = node_.advertise<Message>(what_.topic, 1, looks, [this](const Looker&) { follow_wind(); });
  }
  WindDrawing(const WindDrawing&) = delete;
  WindDrawing& operator=(const WindDrawing&) = delete;

  /// The map has changed.
  void note_change() {
    drawn_.reset();
    draw_when_due();
  }

 private:
  void follow_wind() {
    if (publisher_.getNumSubscribers() == 0) {
      wind_subscriber_.shutdown();
    } else if (!wind_subscriber_) {
      const boost::function<void(const grid_map_msgs::GridMap::ConstPtr&)> take =
          [this](const grid_map_msgs::GridMap::ConstPtr& message) { take_wind(*message); };
      wind_subscriber_ = node_.subscribe<grid_map_msgs::GridMap>("wind_field", 1, take);
    }
  }

  void take_wind(const grid_map_msgs::GridMap& message) {
    try {
      wind_ = to_wind_field(message);
    } catch (const Error&) {
      return;  // the forecaster complains about it
    }
    if (!drawn_ || what_.differs(*drawn_in_, *wind_)) note_change();
  }

  void draw_when_due() {
    if (publisher_.getNumSubscribers() == 0) return;
    const ros::WallDuration wait = drawn_at_ + period_ - ros::WallTime::now();
    if (wait <= ros::WallDuration(0)) {
      draw();
    } else if (!due_.hasStarted()) {
      due_.setPeriod(wait);
      due_.start();
    }
  }

  void draw() {
    due_.stop();
    if (drawn_ || !wind_ || publisher_.getNumSubscribers() == 0) return;
    drawn_at_ = ros::WallTime::now();
    drawn_in_ = wind_;
    drawn_ = what_.draw(*wind_);
    if (drawn_) publisher_.publish(*drawn_);
  }

  ros::NodeHandle node_;
  What what_;
  ros::WallDuration period_;
  std::optional<WindField> wind_;
  std::optional<Message> drawn_;       ///< of the map as it is
  std::optional<WindField> drawn_in_;  ///< the wind of the last drawing
  ros::WallTime drawn_at_;
  ros::WallTimer due_;
  ros::Publisher publisher_;
  ros::Subscriber wind_subscriber_;
};

}  // namespace aeolian
