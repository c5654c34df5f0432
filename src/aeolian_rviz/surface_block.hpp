#pragma once

#include <vector>

#include "aeolian_rviz/block_cells.hpp"
#include "aeolian_rviz/block_triangles.hpp"
#include "aeolian_rviz/height_map_colours.hpp"
#include <OgreHardwareVertexBuffer.h>
#include <OgreMaterial.h>
#include <OgreSimpleRenderable.h>
#include <OgreTexture.h>

namespace aeolian {

/// The places of all blocks' vertices in their textures: the centres of the texels.
Ogre::HardwareVertexBufferSharedPtr make_texture_coordinates();

/// One block of a surface in rviz' scene: vertices at the cells' centres, their colours in a texture of one
/// texel for each cell, so that coarse triangles still show every cell and every contour.
class SurfaceBlock : public Ogre::SimpleRenderable {
 public:
  /// A block of a range of a map's cells.
  SurfaceBlock(const CellRange& cells, const Ogre::HardwareVertexBufferSharedPtr& texture_coordinates);
  ~SurfaceBlock() override;

  /// Takes heights and colours of a part of its cells, for the next upload. Places are relative to the map's
  /// corner and to `base` [m]. Blocks may do so at the same time.
  void take(const GridGeometry& geometry, const HeightMap::Layer& heights, const HeightMap::Layer& values,
            const HeightMapColours& colours, const CellRange& part, double base);
  /// Moves what was taken into the buffers.
  void upload(const GridGeometry& geometry);
  /// Takes effect at once; costs nothing when neither levels nor holes have changed.
  void set_levels(const BlockLevels& levels);
  /// 0 (not to be seen) to 1.
  void set_alpha(float alpha);

  const CellRange& cells() const { return cells_; }
  bool empty() const { return !known_; }
  bool has_holes() const { return holes_; }
  std::size_t count_triangles(int level) const;
  std::size_t drawn_triangles() const { return mRenderOp.indexData->indexCount / 3; }

  void _updateRenderQueue(Ogre::RenderQueue* queue) override;
  Ogre::Real getBoundingRadius() const override;
  Ogre::Real getSquaredViewDepth(const Ogre::Camera* camera) const override;

 private:
  bool holds_unknown() const;
  void set_transparency();
  void upload_vertices(const GridGeometry& geometry);
  void upload_colours();
  void set_bounds(const GridGeometry& geometry);

  CellRange cells_;
  CellRange taken_{0, 0, 0, 0};  ///< not uploaded yet, from the block's first cell
  BlockCells vertices_;
  std::vector<std::vector<Rgba>> texels_;  ///< a level of the texture each, the finest first
  Ogre::HardwareVertexBufferSharedPtr positions_;
  Ogre::TexturePtr texture_;
  BlockLevels levels_;
  float alpha_ = 1;
  bool known_ = false;  ///< some cell's height is
  bool holes_ = false;  ///< some cell's is not
  bool triangles_are_old_ = true;
};

}  // namespace aeolian
