#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/surface/height_map.hpp"
#include "aeolian_core/surface/tile_mask.hpp"

namespace aeolian {

/// Loose grains, and below them sintered ones, over ground that nothing moves.
///
/// Both layers are whole numbers of a 1024th of a parcel, so that nothing is ever lost, whatever is added in
/// which order. The surface is kept beside them as floats above a datum, as flights need it: a row of nx + 1
/// values for each of ny + 1 rows, the last of each those of the opposite border (periodic) or the same again
/// (open). Unknown cells are holes: they have the height of their surroundings and keep nothing.
class ErodibleBed {
 public:
  static constexpr std::int32_t parcel_units = 1024;

  /// Layers of the map: `elevation`; `ground`, without which (or where it is unknown) grains reach down
  /// without end; `sintered`, depth of bonded snow on the ground [m]. `parcel`: thickness [m]. Throws Error
  /// for a map without a known cell.
  ErodibleBed(const HeightMap& map, double parcel, bool periodic);

  const GridGeometry& geometry() const { return geometry_; }
  bool periodic() const { return periodic_; }
  double parcel() const { return parcel_; }
  double unit() const { return unit_; }  ///< [m]
  double parcel_volume() const { return parcel_ * geometry_.cell() * geometry_.cell(); }

  const float* surface() const { return surface_.data(); }
  int stride() const { return geometry_.nx() + 1; }
  float height(int ix, int iy) const {
    return surface_[static_cast<std::size_t>(iy) * static_cast<std::size_t>(stride()) +
                    static_cast<std::size_t>(ix)];
  }
  float highest() const { return highest_; }  ///< no surface is above
  /// No surface is above in a block of 8 x 8 cells, from their centres to those of the next blocks' first.
  static constexpr int block_cells = 8;
  float highest_of_block(int block_x, int block_y) const {
    return highest_of_block_[static_cast<std::size_t>(block_y) * static_cast<std::size_t>(blocks_x_) +
                             static_cast<std::size_t>(block_x)];
  }
  /// The last places at which the surface can be looked up [cells].
  float last_x() const { return last_x_; }
  float last_y() const { return last_y_; }

  std::int32_t loose(std::size_t cell) const { return loose_[cell]; }
  std::int32_t sintered(std::size_t cell) const { return sintered_[cell]; }
  bool hole(std::size_t cell) const { return hole_[cell] != 0; }
  /// Whether a parcel could be taken.
  bool covered(std::size_t cell) const {
    return loose_[cell] >= parcel_units || sintered_[cell] >= parcel_units;
  }
  /// Cells of a tile from which one could; tiles row by row.
  int covered_in_tile(std::size_t tile) const { return covered_in_tile_[tile]; }

  void add_loose(CellIndex c, std::int32_t units) { change(c, geometry_.index(c), units, 0); }
  void add_loose(std::size_t cell, std::int32_t units) { change(geometry_.cell_at(cell), cell, units, 0); }
  void add_sintered(std::size_t cell, std::int32_t units) { change(geometry_.cell_at(cell), cell, 0, units); }
  /// Loose grains become sintered ones.
  void sinter(std::size_t cell) { change(geometry_.cell_at(cell), cell, -loose_[cell], loose_[cell]); }
  /// All that lies on the ground becomes ground.
  void turn_to_ground();

  /// Sum over the cells of what lies on the ground, or did before it turned to ground.
  std::int64_t total_units() const;
  double elevation(std::size_t cell) const {
    return base_[cell] + unit_ * (static_cast<double>(loose_[cell]) + sintered_[cell]);
  }
  /// Elevation of the datum that the surface is above [m].
  double datum() const { return datum_; }

  /// Cells whose height has changed since they were last forgotten: a flag for each, and their tiles.
  /// @{
  std::vector<std::uint8_t>& dirty() { return dirty_; }
  TileMask& dirty_tiles() { return dirty_tiles_; }
  /// @}
  /// Tiles that have changed since the last call.
  TileMask take_changed();

 private:
  void change(CellIndex c, std::size_t cell, std::int32_t loose, std::int32_t sintered);
  void show(CellIndex c, std::size_t cell);
  void raise_blocks(CellIndex c, float height);

  GridGeometry geometry_;
  bool periodic_;
  double parcel_, unit_;
  int blocks_x_, blocks_y_;
  double datum_ = 0;
  std::int64_t ground_units_ = 0;  ///< that have become ground
  float highest_ = 0;
  float last_x_, last_y_;
  std::vector<double> base_;  ///< elevation of the ground [m]
  std::vector<std::int32_t> loose_, sintered_;
  std::vector<std::uint8_t> hole_;
  std::vector<float> surface_;
  std::vector<int> covered_in_tile_;
  std::vector<float> highest_of_block_;
  std::vector<std::uint8_t> dirty_;
  TileMask dirty_tiles_, changed_;
};

}  // namespace aeolian
