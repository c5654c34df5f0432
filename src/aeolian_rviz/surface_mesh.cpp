#include "aeolian_rviz/surface_mesh.hpp"

#include <algorithm>
#include <cmath>

#include <OgreCamera.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreViewport.h>
#include <tbb/parallel_for.h>

namespace aeolian {
namespace {

double lowest(const HeightMap::Layer& heights) {
  float low = std::numeric_limits<float>::infinity();
  for (const float z : heights)
    if (std::isfinite(z)) low = std::min(low, z);
  return std::isfinite(low) ? static_cast<double>(low) : 0;
}

}  // namespace

SurfaceMesh::SurfaceMesh(Ogre::SceneNode* parent)
    : parent_(parent),
      node_(parent->createChildSceneNode()),
      texture_coordinates_(make_texture_coordinates()) {}

SurfaceMesh::~SurfaceMesh() {
  clear();
  node_->getCreator()->destroySceneNode(node_);
}

void SurfaceMesh::clear() {
  for (Part& part : parts_) {
    part.block.reset();
    node_->getCreator()->destroySceneNode(part.node);
  }
  parts_.clear();
  geometry_ = GridGeometry();
}

void SurfaceMesh::rebuild(const GridGeometry& geometry, const HeightMap::Layer& heights) {
  clear();
  const BlockGrid grid(geometry);
  across_ = grid.across;
  for (const CellRange& cells : grid.ranges) {
    parts_.push_back(
        {node_->createChildSceneNode(), std::make_unique<SurfaceBlock>(cells, texture_coordinates_)});
    parts_.back().node->attachObject(parts_.back().block.get());
    parts_.back().block->set_alpha(alpha_);
  }
  geometry_ = geometry;
  base_ = lowest(heights);
}

void SurfaceMesh::update(const GridGeometry& geometry, const HeightMap::Layer& heights,
                         const HeightMap::Layer& values, const Colouring& colouring,
                         const TileMask& changed) {
  const bool anew = geometry != geometry_;
  if (anew) rebuild(geometry, heights);
  const HeightMapColours colours(colouring);
  const TileMask all = anew ? TileMask(geometry, true) : TileMask();
  std::vector<std::pair<SurfaceBlock*, CellRange>> work;
  for (const Part& part : parts_)
    if (const auto cells = changed_part(anew ? all : changed, part.block->cells()))
      work.emplace_back(part.block.get(), *cells);
  tbb::parallel_for(std::size_t{0}, work.size(), [&](std::size_t i) {
    work[i].first->take(geometry, heights, values, colours, work[i].second, base_);
  });
  for (const auto& [block, cells] : work) block->upload(geometry);  // OpenGL is this thread's alone
}

void SurfaceMesh::place(const Ogre::Vector3& position, const Ogre::Quaternion& orientation,
                        const std::array<double, 2>& centre, double exaggeration) {
  const Ogre::Vector3 corner(static_cast<float>(geometry_.origin_x() - centre[0]),
                             static_cast<float>(geometry_.origin_y() - centre[1]), static_cast<float>(base_));
  node_->setPosition(position + orientation * corner);
  node_->setOrientation(orientation);
  node_->setScale(1, 1, static_cast<float>(exaggeration));
}

void SurfaceMesh::set_visible(bool visible) {
  if (visible == visible_) return;
  visible_ = visible;
  if (visible)
    parent_->addChild(node_);
  else
    parent_->removeChild(node_);
}

void SurfaceMesh::set_alpha(float alpha) {
  alpha_ = alpha;
  for (const Part& part : parts_) part.block->set_alpha(alpha);
}

int SurfaceMesh::level_of(const SurfaceBlock& block, const Ogre::Viewport& viewport,
                          double quad_pixels) const {
  const Ogre::Camera& camera = *viewport.getCamera();
  const Ogre::Vector3 scale = node_->getScale();
  const Ogre::AxisAlignedBox& box = block.getBoundingBox();
  if (box.isNull()) return 0;
  const Ogre::AxisAlignedBox scaled(box.getMinimum() * scale, box.getMaximum() * scale);
  const Ogre::Vector3 eye =
      node_->getOrientation().Inverse() * (camera.getDerivedPosition() - node_->getPosition());
  const auto distance = static_cast<double>(scaled.distance(eye));
  const Ogre::Matrix4& projection = camera.getProjectionMatrix();
  const bool parallel = projection[3][3] == 1;
  const double pixels_per_metre = static_cast<double>(std::abs(projection[1][1])) *
                                  viewport.getActualHeight() / 2 /
                                  (parallel ? 1.0 : std::max(distance, 1e-9));
  const int level = detail_level(geometry_.cell() * pixels_per_metre, quad_pixels);
  return block.has_holes() ? std::min(level, coarsest_level_at_holes) : level;
}

void SurfaceMesh::set_detail(const Ogre::Viewport& viewport, double quad_pixels) {
  std::vector<int> levels;
  levels.reserve(parts_.size());
  for (const Part& part : parts_) levels.push_back(level_of(*part.block, viewport, quad_pixels));
  const auto count = static_cast<int>(parts_.size());
  for (int i = 0; i < count; ++i) {
    const auto beside = [&](bool there, int j) { return levels[static_cast<std::size_t>(there ? j : i)]; };
    const int column = i % across_;
    parts_[static_cast<std::size_t>(i)].block->set_levels(
        {levels[static_cast<std::size_t>(i)], beside(column > 0, i - 1), beside(column + 1 < across_, i + 1),
         beside(i >= across_, i - across_), beside(i + across_ < count, i + across_)});
  }
}

std::size_t SurfaceMesh::count_triangles(const Ogre::Viewport& viewport, double quad_pixels) const {
  std::size_t count = 0;
  for (const Part& part : parts_)
    if (viewport.getCamera()->isVisible(part.node->_getWorldAABB()))
      count += part.block->count_triangles(level_of(*part.block, viewport, quad_pixels));
  return count;
}

std::size_t SurfaceMesh::drawn_triangles() const {
  std::size_t count = 0;
  for (const Part& part : parts_) count += part.block->drawn_triangles();
  return count;
}

}  // namespace aeolian
