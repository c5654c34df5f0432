#pragma once

#include <functional>
#include <string>

#include <grid_map_msgs/GridMap.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// Keeps the map that a node publishes: whole maps on `topic`, what changed of them on `topic`_updates (grid
/// maps of a part of the cells, the same layers). Tells after each message which tiles differ from before.
class MapReceiver {
 public:
  /// The whole map after a message, its header and the tiles that hold a value that differs from before (all
  /// tiles when the grid or the layers are new).
  using Taken =
      std::function<void(const HeightMap& map, const std_msgs::Header& header, const TileMask& changed)>;
  /// One line about a message that is no map, or a part that fits none; the last map is kept.
  using Refused = std::function<void(const std::string& reason)>;

  MapReceiver(ros::NodeHandle& node, const std::string& topic, Taken taken, Refused refused);
  MapReceiver(const MapReceiver&) = delete;
  MapReceiver& operator=(const MapReceiver&) = delete;

  /// As resolved by the node handle.
  std::string topic() const { return whole_.getTopic(); }

 private:
  void take_whole(const grid_map_msgs::GridMap::ConstPtr& message);
  void take_part(const grid_map_msgs::GridMap::ConstPtr& message);

  Taken taken_;
  Refused refused_;
  HeightMap map_;
  ros::Subscriber whole_;
  ros::Subscriber updates_;
};

}  // namespace aeolian
