#pragma once

#include <memory>

#include <grid_map_msgs/GridMap.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>

#include "aeolian_core/surface/tile_mask.hpp"
#include "aeolian_core/surface/unseen_changes.hpp"
#include "aeolian_twin/nodes/live_map.hpp"

namespace aeolian {

/// Publishes a live map: whole on `height_map`, or, when asked to be incremental, only the tiles that differ
/// notably from what was published, as grid maps of a rectangle each on `height_map_updates`. One who starts
/// to listen on either topic gets the whole map. Nothing is made that nobody listens to.
class MapPublisher {
 public:
  /// `live` must outlive the publisher.
  MapPublisher(ros::NodeHandle& node, const LiveMap& live, bool incremental);
  MapPublisher(const MapPublisher&) = delete;
  MapPublisher& operator=(const MapPublisher&) = delete;

  /// Values of these tiles have changed, or, without an argument, the map is another one.
  void note(const TileMask& changed);
  void note_all() { unseen_.reset(); }
  /// Publishes what has changed.
  void publish();

 private:
  std_msgs::Header header() const;
  grid_map_msgs::GridMap whole() const;
  void send_whole(const ros::SingleSubscriberPublisher& to) const;
  void publish_changes();
  void publish_all_as_update();

  const LiveMap& live_;
  bool incremental_;
  TileMask changed_;
  std::unique_ptr<UnseenChanges> unseen_;
  ros::Publisher whole_publisher_;
  ros::Publisher updates_publisher_;
};

}  // namespace aeolian
