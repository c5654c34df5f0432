#include "aeolian_twin/nodes/crest_publisher.hpp"

#include <cmath>
#include <utility>

#include <ros/single_subscriber_publisher.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/direction.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

/// Crests are found up to 60 degrees off; another wind must not bring them near that.
constexpr double notable_turn = degrees_to_radians(20);

}  // namespace

CrestPublisher::CrestPublisher(ros::NodeHandle& node, double direction, double period, Draw draw)
    : node_(node), direction_(direction), period_(period), draw_(std::move(draw)) {
  due_ = node_.createWallTimer(
      period_, [this](const ros::WallTimerEvent&) { this->draw(); }, /*oneshot=*/true, /*autostart=*/false);
  using Looker = ros::SingleSubscriberPublisher;
  const auto looks = [this](const Looker& to) {
    follow_wind();
    if (drawn_)
      to.publish(*drawn_);
    else
      draw_when_due();
  };
  publisher_ = node_.advertise<visualization_msgs::Marker>("crests", 1, looks,
                                                           [this](const Looker&) { follow_wind(); });
}

void CrestPublisher::note_change() {
  drawn_.reset();
  draw_when_due();
}

void CrestPublisher::follow_wind() {
  if (publisher_.getNumSubscribers() == 0) {
    wind_subscriber_.shutdown();
  } else if (!wind_subscriber_) {
    const boost::function<void(const grid_map_msgs::GridMap::ConstPtr&)> take =
        [this](const grid_map_msgs::GridMap::ConstPtr& message) { take_wind(*message); };
    wind_subscriber_ = node_.subscribe<grid_map_msgs::GridMap>("wind_field", 1, take);
  }
}

void CrestPublisher::take_wind(const grid_map_msgs::GridMap& message) {
  try {
    direction_ = to_wind_field(message).direction;
  } catch (const Error&) {
    return;  // the forecaster complains about it
  }
  if (drawn_ && std::abs(wrap_angle(direction_ - drawn_direction_)) > notable_turn) note_change();
}

void CrestPublisher::draw_when_due() {
  if (publisher_.getNumSubscribers() == 0) return;
  const ros::WallDuration wait = drawn_at_ + period_ - ros::WallTime::now();
  if (wait <= ros::WallDuration(0)) {
    draw();
  } else if (!due_.hasStarted()) {
    due_.setPeriod(wait);
    due_.start();
  }
}

void CrestPublisher::draw() {
  due_.stop();
  if (drawn_ || publisher_.getNumSubscribers() == 0) return;
  drawn_at_ = ros::WallTime::now();
  drawn_direction_ = direction_;
  drawn_ = draw_(direction_);
  if (drawn_) publisher_.publish(*drawn_);
}

}  // namespace aeolian
