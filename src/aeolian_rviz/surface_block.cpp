#include "aeolian_rviz/surface_block.hpp"

#include <algorithm>
#include <string>

#include <OgreCamera.h>
#include <OgreHardwareBufferManager.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreMaterialManager.h>
#include <OgrePass.h>
#include <OgreSceneNode.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>

namespace aeolian {
namespace {

constexpr std::size_t vertex_count = static_cast<std::size_t>(block_vertices) * block_vertices;
constexpr std::size_t floats_of_a_position = 3;

std::string unique_name() {
  static int count = 0;
  return "aeolian_surface_" + std::to_string(count++);
}

/// rviz has no group for textures and materials of others but Ogre's default.
const std::string& group() { return Ogre::ResourceGroupManager::DEFAULT_RESOURCE_GROUP_NAME; }

constexpr Ogre::PixelFormat pixel_format = Ogre::PF_BYTE_RGBA;

/// The texels of the next level that depend on a range.
CellRange halved(const CellRange& range) {
  return {range.x0 / 2, (range.x1 + 1) / 2, range.y0 / 2, (range.y1 + 1) / 2};
}

Ogre::TexturePtr make_texture(int levels) {
  return Ogre::TextureManager::getSingleton().createManual(unique_name(), group(), Ogre::TEX_TYPE_2D,
                                                           block_vertices, block_vertices, levels - 1,
                                                           pixel_format, Ogre::TU_DYNAMIC_WRITE_ONLY);
}

Ogre::MaterialPtr make_material(const Ogre::TexturePtr& texture) {
  const Ogre::MaterialPtr material = Ogre::MaterialManager::getSingleton().create(unique_name(), group());
  Ogre::Pass* pass = material->getTechnique(0)->getPass(0);
  // The shading is in the colours, so that the picture does not depend on rviz' lamp.
  pass->setLightingEnabled(false);
  pass->setCullingMode(Ogre::CULL_NONE);
  Ogre::TextureUnitState* unit = pass->createTextureUnitState();
  unit->setTexture(texture);
  unit->setTextureAddressingMode(Ogre::TextureUnitState::TAM_CLAMP);
  // The nearest level only: blending two doubles the work of a software renderer.
  unit->setTextureFiltering(Ogre::FO_LINEAR, Ogre::FO_LINEAR, Ogre::FO_POINT);
  return material;
}

}  // namespace

Ogre::HardwareVertexBufferSharedPtr make_texture_coordinates() {
  std::vector<float> places;
  places.reserve(2 * vertex_count);
  for (int y = 0; y < block_vertices; ++y)
    for (int x = 0; x < block_vertices; ++x) {
      places.push_back((static_cast<float>(x) + 0.5F) / block_vertices);
      places.push_back((static_cast<float>(y) + 0.5F) / block_vertices);
    }
  auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
      2 * sizeof(float), vertex_count, Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
  buffer->writeData(0, places.size() * sizeof(float), places.data(), true);
  return buffer;
}

SurfaceBlock::SurfaceBlock(const CellRange& cells,
                           const Ogre::HardwareVertexBufferSharedPtr& texture_coordinates)
    : cells_(cells) {
  for (int size = block_vertices; size >= 1; size /= 2)
    texels_.emplace_back(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
  texture_ = make_texture(static_cast<int>(texels_.size()));
  setMaterial(make_material(texture_));
  set_alpha(1);

  auto& buffers = Ogre::HardwareBufferManager::getSingleton();
  positions_ = buffers.createVertexBuffer(floats_of_a_position * sizeof(float), vertex_count,
                                          Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY);
  mRenderOp.operationType = Ogre::RenderOperation::OT_TRIANGLE_LIST;
  mRenderOp.useIndexes = true;
  mRenderOp.vertexData = new Ogre::VertexData;
  mRenderOp.vertexData->vertexCount = vertex_count;
  Ogre::VertexDeclaration* declaration = mRenderOp.vertexData->vertexDeclaration;
  declaration->addElement(0, 0, Ogre::VET_FLOAT3, Ogre::VES_POSITION);
  declaration->addElement(1, 0, Ogre::VET_FLOAT2, Ogre::VES_TEXTURE_COORDINATES);
  mRenderOp.vertexData->vertexBufferBinding->setBinding(0, positions_);
  mRenderOp.vertexData->vertexBufferBinding->setBinding(1, texture_coordinates);
  mRenderOp.indexData = new Ogre::IndexData;
}

SurfaceBlock::~SurfaceBlock() {
  delete mRenderOp.vertexData;
  delete mRenderOp.indexData;
  Ogre::MaterialManager::getSingleton().remove(mMaterial->getName(), group());
  Ogre::TextureManager::getSingleton().remove(texture_->getName(), group());
}

void SurfaceBlock::take(const GridGeometry& geometry, const HeightMap::Layer& heights,
                        const HeightMap::Layer& values, const HeightMapColours& colours,
                        const CellRange& part, double base) {
  const std::vector<VertexState> before = vertices_.states;
  vertices_.take(geometry, heights, cells_, part, base);
  const bool known_before = known_;
  known_ = std::find(vertices_.states.begin(), vertices_.states.end(), VertexState::known) !=
           vertices_.states.end();
  triangles_are_old_ |= vertices_.states != before;
  holes_ = holds_unknown();
  if (!known_) return;
  const CellRange& drawn = known_before ? part : cells_;
  taken_ = {drawn.x0 - cells_.x0, drawn.x1 - cells_.x0, drawn.y0 - cells_.y0, drawn.y1 - cells_.y0};
  colours.colour(geometry, heights, values, drawn, &texels_[0][BlockCells::index(taken_.x0, taken_.y0)],
                 block_vertices);
  CellRange finer = taken_;
  for (std::size_t level = 0; level + 1 < texels_.size(); ++level) {
    halve(texels_[level].data(), block_vertices >> level, finer, texels_[level + 1].data());
    finer = halved(finer);
  }
}

bool SurfaceBlock::holds_unknown() const {
  for (int y = 0; y < cells_.y1 - cells_.y0; ++y)
    for (int x = 0; x < cells_.x1 - cells_.x0; ++x)
      if (vertices_.states[BlockCells::index(x, y)] != VertexState::known) return true;
  return false;
}

void SurfaceBlock::upload(const GridGeometry& geometry) {
  if (!known_) {
    mRenderOp.indexData->indexCount = 0;
    return;
  }
  set_transparency();
  upload_vertices(geometry);
  upload_colours();
  set_bounds(geometry);
}

void SurfaceBlock::upload_vertices(const GridGeometry& geometry) {
  std::vector<float> rows;
  rows.reserve(floats_of_a_position * static_cast<std::size_t>((taken_.y1 - taken_.y0) * block_vertices));
  for (int y = taken_.y0; y < taken_.y1; ++y)
    for (int x = 0; x < block_vertices; ++x) {
      rows.push_back(static_cast<float>((cells_.x0 + x + 0.5) * geometry.cell()));
      rows.push_back(static_cast<float>((cells_.y0 + y + 0.5) * geometry.cell()));
      rows.push_back(vertices_.heights[BlockCells::index(x, y)]);
    }
  const std::size_t bytes_of_a_row = floats_of_a_position * sizeof(float) * block_vertices;
  positions_->writeData(static_cast<std::size_t>(taken_.y0) * bytes_of_a_row, rows.size() * sizeof(float),
                        rows.data());
}

void SurfaceBlock::upload_colours() {
  CellRange part = taken_;
  for (std::size_t level = 0; level < texels_.size(); ++level) {
    const auto count = [](int i) { return static_cast<Ogre::uint32>(i); };
    const Ogre::PixelBox all(count(block_vertices >> level), count(block_vertices >> level), 1, pixel_format,
                             texels_[level].data());
    const Ogre::Box box(count(part.x0), count(part.y0), count(part.x1), count(part.y1));
    texture_->getBuffer(0, level)->blitFromMemory(all.getSubVolume(box, false), box);
    part = halved(part);
  }
}

void SurfaceBlock::set_bounds(const GridGeometry& geometry) {
  const auto [low, high] = std::minmax_element(vertices_.heights.begin(), vertices_.heights.end());
  const auto metres = [&](int cells) { return static_cast<float>(cells * geometry.cell()); };
  setBoundingBox({metres(cells_.x0), metres(cells_.y0), *low, metres(cells_.x1), metres(cells_.y1), *high});
  if (mParentNode) mParentNode->needUpdate();
}

void SurfaceBlock::set_levels(const BlockLevels& levels) {
  if (!known_ || (levels == levels_ && !triangles_are_old_)) return;
  levels_ = levels;
  triangles_are_old_ = false;
  const std::vector<std::uint16_t> corners =
      block_triangles(cells_.x1 - cells_.x0, cells_.y1 - cells_.y0, levels, vertices_.states);
  Ogre::HardwareIndexBufferSharedPtr& buffer = mRenderOp.indexData->indexBuffer;
  if (!corners.empty() && (!buffer || buffer->getNumIndexes() < corners.size()))
    buffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
        Ogre::HardwareIndexBuffer::IT_16BIT, corners.size(), Ogre::HardwareBuffer::HBU_DYNAMIC_WRITE_ONLY);
  if (!corners.empty()) buffer->writeData(0, corners.size() * sizeof(corners[0]), corners.data());
  mRenderOp.indexData->indexCount = corners.size();
}

void SurfaceBlock::set_alpha(float alpha) {
  alpha_ = alpha;
  set_transparency();
}

void SurfaceBlock::set_transparency() {
  Ogre::Pass* pass = mMaterial->getTechnique(0)->getPass(0);
  Ogre::TextureUnitState* unit = pass->getTextureUnitState(0);
  if (alpha_ < 1)
    unit->setAlphaOperation(Ogre::LBX_MODULATE, Ogre::LBS_TEXTURE, Ogre::LBS_MANUAL, 1, alpha_);
  else
    unit->setAlphaOperation(Ogre::LBX_SOURCE1, Ogre::LBS_TEXTURE, Ogre::LBS_CURRENT);
  // The test keeps a renderer from sorting out hidden pixels early.
  if (holes_)
    pass->setAlphaRejectSettings(Ogre::CMPF_GREATER, static_cast<unsigned char>(127 * alpha_));
  else
    pass->setAlphaRejectFunction(Ogre::CMPF_ALWAYS_PASS);
  pass->setSceneBlending(alpha_ < 1 ? Ogre::SBT_TRANSPARENT_ALPHA : Ogre::SBT_REPLACE);
}

std::size_t SurfaceBlock::count_triangles(int level) const {
  return empty() ? 0 : aeolian::count_triangles(cells_.x1 - cells_.x0, cells_.y1 - cells_.y0, level);
}

void SurfaceBlock::_updateRenderQueue(Ogre::RenderQueue* queue) {
  if (drawn_triangles() > 0) Ogre::SimpleRenderable::_updateRenderQueue(queue);
}

Ogre::Real SurfaceBlock::getBoundingRadius() const { return mBox.getHalfSize().length(); }

Ogre::Real SurfaceBlock::getSquaredViewDepth(const Ogre::Camera* camera) const {
  const Ogre::Vector3 centre = mParentNode->_getFullTransform() * mBox.getCenter();
  return (centre - camera->getDerivedPosition()).squaredLength();
}

}  // namespace aeolian
