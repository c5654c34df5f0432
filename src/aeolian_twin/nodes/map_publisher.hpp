#pragma once

#include <memory>

#include <grid_map_msgs/GridMap.h>
#include <ros/node_handle.h>
#include <ros/publisher.h>
#include <ros/time.h>

#include "aeolian_core/surface/tile_mask.hpp"
#include "aeolian_core/surface/unseen_changes.hpp"
#include "aeolian_twin/nodes/told_map.hpp"

namespace aeolian {

/// Publishes a live map, whole on `height_map` (latched), or, when asked to be incremental, only the tiles
/// that differ notably from what was published, as grid maps of a rectangle each on `height_map_updates`, or
/// a single cell when none does. One who starts to listen on either topic gets the whole map; with updates,
/// all get it again after ten seconds in which it has changed, so that nothing that was lost is missed for
/// long. Nothing is made that nobody listens to. What is shown of a still tile that takes scans together
/// (ToldMap) is at most 1/64 of rate_time old.
class MapPublisher {
 public:
  /// `live` must outlive the publisher.
  MapPublisher(ros::NodeHandle& node, const LiveMap& live, bool incremental);
  MapPublisher(const MapPublisher&) = delete;
  MapPublisher& operator=(const MapPublisher&) = delete;

  /// Values of these tiles have changed, or, without an argument, the map is another one.
  void note(const TileMask& changed);
  void note_all();
  /// Publishes what has changed.
  void publish();

 private:
  grid_map_msgs::GridMap whole() const;
  void send_whole(const ros::SingleSubscriberPublisher& to) const;
  void publish_changes();
  void publish_whole();
  void begin_updates();

  const LiveMap& live_;
  ToldMap told_;
  bool incremental_;
  bool latched_ = false;  ///< the last whole map that was published is the present one
  ros::WallTime whole_at_;
  TileMask changed_;
  std::unique_ptr<UnseenChanges> unseen_;
  ros::Publisher whole_publisher_;
  ros::Publisher updates_publisher_;
};

}  // namespace aeolian
