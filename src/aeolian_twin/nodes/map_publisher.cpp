#include "aeolian_twin/nodes/map_publisher.hpp"

#include "aeolian_core/surface/submap.hpp"
#include "aeolian_twin/nodes/conversions.hpp"

namespace aeolian {

MapPublisher::MapPublisher(ros::NodeHandle& node, const LiveMap& live, bool incremental)
    : live_(live), incremental_(incremental) {
  const auto greet = [this](const ros::SingleSubscriberPublisher& to) { send_whole(to); };
  whole_publisher_ = node.advertise<grid_map_msgs::GridMap>("height_map", 1, greet);
  // A rectangle that is lost would be missed for long: the queue holds those of a few clouds.
  if (incremental)
    updates_publisher_ = node.advertise<grid_map_msgs::GridMap>("height_map_updates", 1000, greet);
}

std_msgs::Header MapPublisher::header() const {
  std_msgs::Header header;
  header.frame_id = live_.frame();
  header.stamp = live_.stamp();
  return header;
}

grid_map_msgs::GridMap MapPublisher::whole() const { return to_message(live_.map(), header()); }

void MapPublisher::send_whole(const ros::SingleSubscriberPublisher& to) const {
  if (live_.begun() && !live_.stamp().isZero()) to.publish(whole());
}

void MapPublisher::note(const TileMask& changed) {
  if (unseen_) changed_.merge(changed);
}

void MapPublisher::publish() {
  const bool all_is_new = !unseen_;
  if (whole_publisher_.getNumSubscribers() > 0 && (!incremental_ || all_is_new))
    whole_publisher_.publish(whole());
  if (!incremental_) return;
  if (all_is_new)
    publish_all_as_update();
  else if (updates_publisher_.getNumSubscribers() > 0)
    publish_changes();
}

void MapPublisher::publish_all_as_update() {
  const GridGeometry& geometry = live_.map().geometry();
  changed_ = TileMask(geometry);
  unseen_ = std::make_unique<UnseenChanges>(geometry);
  unseen_->take(live_.map(), TileMask(geometry, true));
  if (updates_publisher_.getNumSubscribers() > 0) updates_publisher_.publish(whole());
}

void MapPublisher::publish_changes() {
  const HeightMap& map = live_.map();
  const TileMask news = unseen_->take(map, changed_);
  changed_.clear();
  for (const CellRange& range : rectangles(news))
    updates_publisher_.publish(to_message(submap(map, range), header()));
}

}  // namespace aeolian
