#include "aeolian_rviz/surface_mesh.hpp"

#include <cmath>

#include <OgreManualObject.h>
#include <OgreMaterialManager.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreTechnique.h>

namespace aeolian {
namespace {

std::string unique_name() {
  static int count = 0;
  return "aeolian_surface_" + std::to_string(count++);
}

}  // namespace

SurfaceMesh::SurfaceMesh(Ogre::SceneManager* scene, Ogre::SceneNode* node)
    : scene_(scene), node_(node), object_(nullptr), material_(unique_name()) {
  // The shading is in the colours, so that the picture does not depend on rviz' lamp; rviz has no group for
  // materials of others but Ogre's default.
  const auto material = Ogre::MaterialManager::getSingleton().create(
      material_, Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  material->getTechnique(0)->setLightingEnabled(false);
  material->getTechnique(0)->setCullingMode(Ogre::CULL_NONE);
  object_ = scene_->createManualObject(material_);
  object_->setDynamic(true);
  node_->attachObject(object_);
}

SurfaceMesh::~SurfaceMesh() {
  node_->detachObject(object_);
  scene_->destroyManualObject(object_);
  Ogre::MaterialManager::getSingleton().remove(material_,
                                               Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
}

void SurfaceMesh::clear() {
  object_->clear();
  nx_ = ny_ = 0;
}

void SurfaceMesh::update(const GridGeometry& geometry, const HeightMap::Layer& heights,
                         const std::vector<Rgb>& colours, double exaggeration) {
  if (nx_ == geometry.nx() && ny_ == geometry.ny()) {
    object_->beginUpdate(0);
  } else {
    clear();
    nx_ = geometry.nx();
    ny_ = geometry.ny();
    object_->estimateVertexCount(geometry.size());
    object_->estimateIndexCount(6 * geometry.size());
    object_->begin(material_, Ogre::RenderOperation::OT_TRIANGLE_LIST,
                   Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME);
  }
  for (int iy = 0; iy < ny_; ++iy)
    for (int ix = 0; ix < nx_; ++ix) {
      const std::size_t i = geometry.index(ix, iy);
      const double height = std::isfinite(heights[i]) ? static_cast<double>(heights[i]) : 0.0;
      object_->position(static_cast<float>(geometry.x(ix) - geometry.origin_x()),
                        static_cast<float>(geometry.y(iy) - geometry.origin_y()),
                        static_cast<float>(height * exaggeration));
      const Rgb& c = colours[i];
      object_->colour(static_cast<float>(c[0]) / 255.0F, static_cast<float>(c[1]) / 255.0F,
                      static_cast<float>(c[2]) / 255.0F);
    }
  for (int iy = 0; iy + 1 < ny_; ++iy)
    for (int ix = 0; ix + 1 < nx_; ++ix) {
      const std::size_t a = geometry.index(ix, iy);
      const std::size_t b = a + 1;
      const std::size_t c = geometry.index(ix, iy + 1);
      const std::size_t d = c + 1;
      const bool whole = std::isfinite(heights[a] + heights[b] + heights[c] + heights[d]);
      if (!whole) continue;
      const auto index = [](std::size_t i) { return static_cast<Ogre::uint32>(i); };
      object_->quad(index(a), index(b), index(d), index(c));
    }
  object_->end();
}

}  // namespace aeolian
