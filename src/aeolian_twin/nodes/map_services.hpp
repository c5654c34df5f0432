#pragma once

#include <functional>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <grid_map_msgs/GetGridMap.h>
#include <grid_map_msgs/ProcessFile.h>
#include <grid_map_msgs/SetGridMap.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <std_srvs/Empty.h>
#include <tf2_ros/buffer.h>

#include "aeolian_core/surface/tile_mask.hpp"
#include "aeolian_twin/nodes/live_map.hpp"

namespace aeolian {

/// The services of a live map, under the names and with the types that users of height maps know: save_map,
/// load_map, clear_map, get_submap, masked_replace, enable_updates, disable_updates.
///
/// A request that cannot be met leaves the map as it is, is told of, and is answered by success = false, or
/// by a failed call where the answer has no such field.
class MapServices {
 public:
  /// The node that offers them.
  struct Host {
    LiveMap& live;
    const tf2_ros::Buffer& transforms;
    std::function<std::string()> default_file = {};  ///< of requests that name none
    std::function<void()> is_another = {};           ///< the map has been loaded or cleared
    std::function<void(const TileMask&)> has_changed = {};
    std::function<void(const std::string& service, const std::string& line)> good = {};
    std::function<void(const std::string& service, const std::string& line)> bad = {};
  };

  MapServices(ros::NodeHandle& node, Host host);
  MapServices(const MapServices&) = delete;
  MapServices& operator=(const MapServices&) = delete;

  /// Whether clouds are to be used.
  bool updates_enabled() const { return updates_enabled_; }

 private:
  using Empty = std_srvs::Empty;
  using GetGridMap = grid_map_msgs::GetGridMap;
  using ProcessFile = grid_map_msgs::ProcessFile;
  using SetGridMap = grid_map_msgs::SetGridMap;

  bool save(ProcessFile::Request& request, ProcessFile::Response& response);
  bool load(ProcessFile::Request& request, ProcessFile::Response& response);
  bool clear(Empty::Request& request, Empty::Response& response);
  bool get_submap(GetGridMap::Request& request, GetGridMap::Response& response);
  bool masked_replace(SetGridMap::Request& request, SetGridMap::Response& response);
  bool enable_updates(Empty::Request& request, Empty::Response& response);
  bool disable_updates(Empty::Request& request, Empty::Response& response);

  template <class Work>
  bool attempt(const std::string& service, Work&& work);
  std::string file_of(const ProcessFile::Request& request) const;
  Eigen::Vector2d position_of(const GetGridMap::Request& request) const;

  Host host_;
  bool updates_enabled_ = true;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace aeolian
