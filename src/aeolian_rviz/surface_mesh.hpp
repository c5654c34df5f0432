#pragma once

#include <string>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/shading.hpp"

namespace Ogre {
class ManualObject;
class SceneManager;
class SceneNode;
}  // namespace Ogre

namespace aeolian {

/// A height map as one indexed triangle mesh in rviz' scene. The buffers are kept while the map keeps its
/// size.
class SurfaceMesh {
 public:
  SurfaceMesh(Ogre::SceneManager* scene, Ogre::SceneNode* node);
  ~SurfaceMesh();
  SurfaceMesh(const SurfaceMesh&) = delete;
  SurfaceMesh& operator=(const SurfaceMesh&) = delete;

  /// Draws `heights` [m], times `exaggeration`, in the given colours, one for each cell. Triangles that touch
  /// an unknown cell are left out.
  void update(const GridGeometry& geometry, const HeightMap::Layer& heights, const std::vector<Rgb>& colours,
              double exaggeration);
  void clear();

 private:
  Ogre::SceneManager* scene_;
  Ogre::SceneNode* node_;
  Ogre::ManualObject* object_;
  std::string material_;
  int nx_ = 0;
  int ny_ = 0;
};

}  // namespace aeolian
