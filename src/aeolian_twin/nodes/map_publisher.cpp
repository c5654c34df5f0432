#include "aeolian_twin/nodes/map_publisher.hpp"

#include <ros/single_subscriber_publisher.h>

#include "aeolian_core/surface/submap.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {
namespace {

const ros::WallDuration whole_again(10);

}  // namespace

MapPublisher::MapPublisher(ros::NodeHandle& node, const LiveMap& live, bool incremental)
    : live_(live), told_(live), incremental_(incremental) {
  const auto greet = [this](const ros::SingleSubscriberPublisher& to) {
    const bool has_it = latched_ && to.getTopic() == whole_publisher_.getTopic();
    if (!has_it && live_.begun() && !live_.stamp().isZero()) to.publish(whole());
  };
  whole_publisher_ =
      node.advertise<grid_map_msgs::GridMap>("height_map", 1, greet, {}, nullptr, /*latch=*/true);
  // A rectangle that is lost would be missed for a while: the queue holds those of a few clouds.
  if (incremental)
    updates_publisher_ = node.advertise<grid_map_msgs::GridMap>("height_map_updates", 1000, greet);
}

grid_map_msgs::GridMap MapPublisher::whole() const { return to_message(live_.map(), live_.header()); }

void MapPublisher::note(const TileMask& changed) {
  latched_ = false;
  told_.note(changed);
  if (unseen_) changed_.merge(changed);
}

void MapPublisher::note_all() {
  latched_ = false;
  told_.note_all();
  unseen_.reset();
}

void MapPublisher::publish() {
  const bool is_another = !unseen_;
  if (incremental_ && is_another) begin_updates();
  const bool due = !incremental_ || is_another || ros::WallTime::now() - whole_at_ >= whole_again;
  if (due && whole_publisher_.getNumSubscribers() > 0) publish_whole();
  if (!incremental_ || updates_publisher_.getNumSubscribers() == 0) return;
  if (is_another)
    updates_publisher_.publish(whole());
  else
    publish_changes();
}

void MapPublisher::publish_whole() {
  whole_publisher_.publish(to_message(told_.tell(), live_.header()));
  latched_ = true;
  whole_at_ = ros::WallTime::now();
}

void MapPublisher::begin_updates() {
  const GridGeometry& geometry = live_.map().geometry();
  changed_ = TileMask(geometry);
  unseen_ = std::make_unique<UnseenChanges>(geometry);
  unseen_->take(live_.map(), TileMask(geometry, true));
}

void MapPublisher::publish_changes() {
  const HeightMap& map = live_.map(changed_);
  const TileMask news = unseen_->take(map, changed_);
  changed_.clear();
  std::vector<CellRange> parts = rectangles(news);
  if (parts.empty()) parts.push_back({0, 1, 0, 1});  // a cell, to say that the map holds at this time, too
  for (const CellRange& part : parts)
    updates_publisher_.publish(to_message(submap(map, part), live_.header()));
}

}  // namespace aeolian
