#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <grid_map_msgs/GridMap.h>
#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <ros/wall_timer.h>

#include "aeolian_core/surface/held_map.hpp"

namespace aeolian {

/// What a node wants of a map that it receives.
struct WantedMap {
  /// Others are not even read; empty: all.
  std::vector<std::string> layers;
  /// Throws Error for a header that is not wanted.
  std::function<void(const std::string& topic, const std_msgs::Header& header)> accept;
  std::uint32_t queue_size = 1;  ///< whole maps that may wait to be taken
};

/// Keeps the map that a node publishes: whole maps on `topic`, what changed of them on `topic`_updates (grid
/// maps of a part of the cells, the same layers). Tells after each message which tiles differ from before;
/// parts of one stamp are one change, which is told when all have come.
///
/// The publisher sends the whole map to each new subscriber of either topic, and on both when its grid is
/// new. A publisher without updates is understood as well.
class MapReceiver {
 public:
  /// The whole map, its header and the tiles that hold a value that differs from before in a wanted
  /// layer (all tiles when the grid or the layers are new; none when the map is confirmed).
  using Taken =
      std::function<void(const HeightMap& map, const std_msgs::Header& header, const TileMask& changed)>;
  /// One line, with the topic, about a message that is no map or is not accepted; the last map is kept.
  using Refused = std::function<void(const std::string& reason)>;

  MapReceiver(ros::NodeHandle& node, const std::string& topic, Taken taken, Refused refused,
              WantedMap wanted = {});
  MapReceiver(const MapReceiver&) = delete;
  MapReceiver& operator=(const MapReceiver&) = delete;

  /// As resolved by the node handle.
  std::string topic() const { return whole_.getTopic(); }
  /// Whether a map has been told, and the last one.
  bool known() const { return held_.known(); }
  const HeightMap& map() const { return held_.map(); }

 private:
  using Message = grid_map_msgs::GridMap;

  void take_whole(const Message& message);
  void take_part(const Message& message);
  HeightMap decode(const Message& message, const std::string& topic) const;
  void tell();
  /// Does some work; an Error goes to `refused`.
  template <class Work>
  void guarded(Work&& work);

  Taken taken_;
  Refused refused_;
  WantedMap wanted_;
  HeldMap held_;
  std_msgs::Header header_;           ///< of the newest message in the map
  std::optional<TileMask> not_told_;  ///< what the parts of one stamp have changed
  ros::WallTimer last_part_;
  ros::Subscriber whole_;
  ros::Subscriber updates_;
};

}  // namespace aeolian
