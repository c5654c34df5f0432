#pragma once

#include <memory>
#include <vector>

#include "aeolian_rviz/height_map_colours.hpp"
#include "aeolian_rviz/surface_block.hpp"
#include <OgreHardwareVertexBuffer.h>
#include <OgreQuaternion.h>
#include <OgreVector.h>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace Ogre {
class Camera;
class SceneManager;
class SceneNode;
class Viewport;
}  // namespace Ogre

namespace aeolian {

/// A height map as a surface in rviz' scene: blocks that keep their buffers while the grid stays the same,
/// each at a level of detail of its own, joined without cracks.
class SurfaceMesh {
 public:
  explicit SurfaceMesh(Ogre::SceneNode* parent);
  ~SurfaceMesh();
  SurfaceMesh(const SurfaceMesh&) = delete;
  SurfaceMesh& operator=(const SurfaceMesh&) = delete;

  /// Draws the tiles that have changed; all of them when the grid is another.
  void update(const GridGeometry& geometry, const HeightMap::Layer& heights, const HeightMap::Layer& values,
              const Colouring& colouring, const TileMask& changed);
  void clear();

  /// Puts it into the scene: pose of the map's frame, minus `centre` (x, y) of that frame [m]. Heights above
  /// the lowest of the first map are drawn `exaggeration` times as high.
  void place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation,
             const std::array<double, 2>& centre, double exaggeration);
  void set_visible(bool visible);
  void set_alpha(float alpha);

  /// Chooses each block's level, so that its quads are at most so large [pixels] in a viewport's picture.
  void set_detail(const Ogre::Viewport& viewport, double quad_pixels);
  /// How many triangles that makes within the picture; holes and edges are not counted.
  std::size_t count_triangles(const Ogre::Viewport& viewport, double quad_pixels) const;
  /// As drawn, in all blocks.
  std::size_t drawn_triangles() const;

  const GridGeometry& geometry() const { return geometry_; }

 private:
  struct Part {
    Ogre::SceneNode* node;
    std::unique_ptr<SurfaceBlock> block;
  };
  void rebuild(const GridGeometry& geometry, const HeightMap::Layer& heights);
  int level_of(const SurfaceBlock& block, const Ogre::Viewport& viewport, double quad_pixels) const;

  Ogre::SceneNode* parent_;
  Ogre::SceneNode* node_;
  Ogre::HardwareVertexBufferSharedPtr texture_coordinates_;
  GridGeometry geometry_;
  double base_ = 0;  ///< height of the node's origin [m]
  float alpha_ = 1;
  bool visible_ = true;
  std::vector<Part> parts_;  ///< in the order of BlockGrid
  int across_ = 0;
};

}  // namespace aeolian
