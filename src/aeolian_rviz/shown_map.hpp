#pragma once

#include <memory>
#include <string>

#include "aeolian_rviz/surface_mesh.hpp"
#include <OgreQuaternion.h>
#include <OgreVector.h>
#include <ros/node_handle.h>
#include <std_msgs/Header.h>

#include "aeolian_core/surface/tile_mask.hpp"
#include "aeolian_twin/nodes/map_receiver.hpp"

namespace aeolian {

/// What of a map is drawn and how.
struct Look {
  std::string height_layer;
  std::string colour_layer;
  Colouring colouring;
  friend bool operator==(const Look& a, const Look& b) {
    return a.height_layer == b.height_layer && a.colour_layer == b.colour_layer && a.colouring == b.colouring;
  }
};

/// The map of one topic and its surface. Messages only mark what has changed; it is drawn once a frame, so
/// that no more is drawn than seen, however fast they come.
class ShownMap {
 public:
  explicit ShownMap(Ogre::SceneNode* parent) : mesh_(parent) {}

  /// Forgets the map and waits for those of a topic; none when it is empty. Throws ros::Exception for a bad
  /// name.
  void listen(ros::NodeHandle& node, const std::string& topic);

  bool known() const { return map_ != nullptr; }
  const HeightMap& map() const { return *map_; }
  const std_msgs::Header& header() const { return header_; }
  std::size_t taken() const { return taken_; }
  std::size_t refused() const { return refused_; }
  /// Why the latest message was refused; empty when it was not.
  const std::string& complaint() const { return complaint_; }

  /// Draws what has changed since the last time. Throws Error when a layer is absent; the surface stays.
  void draw(const Look& look);
  SurfaceMesh& mesh() { return mesh_; }
  const SurfaceMesh& mesh() const { return mesh_; }

 private:
  void take(const HeightMap& map, const std_msgs::Header& header, const TileMask& changed);

  SurfaceMesh mesh_;
  std::unique_ptr<MapReceiver> receiver_;
  const HeightMap* map_ = nullptr;  ///< the receiver's
  std_msgs::Header header_;
  GridGeometry marked_;  ///< the grid of `changed_`
  TileMask changed_;     ///< not drawn yet
  bool pending_ = false;
  Look look_;
  std::size_t taken_ = 0;
  std::size_t refused_ = 0;
  std::string complaint_;
};

}  // namespace aeolian
