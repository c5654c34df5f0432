#pragma once

#include <cstdint>
#include <vector>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/bedforms/lattice/ejection_draws.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// A bed of single grains on a stretched lattice (Werner 1987, ch. VI; specification sec. 5.2), in three
/// dimensions.
///
/// Columns stand on a square grid; heights are whole numbers of layers with the parity of the column,
/// neighbours differ by exactly one layer, and the layer spacing makes the steepest face along an axis the
/// angle of repose. A pocket is a local minimum (a grain there raises it by two layers), a free grain a local
/// maximum. Grains are never made or lost, so volume is exact. The lattice is periodic along both axes.
///
/// An impact comes in along the wind at the impact angle, strikes the first column in its way, and sets the
/// free grain at the top of the struck slope reptating by an exponentially distributed length; it comes to
/// rest in the next pocket down the slope. Impacts are conserved: what a crest shades off the bed behind it
/// has struck the crest's stoss.
class LatticeBed {
 public:
  /// A flat bed of `nx` x `ny` columns (both even), roughened by `roughening` random moves per column.
  /// `spacing` is the distance of columns [m]. Throws Error naming what is not allowed.
  LatticeBed(int nx, int ny, double spacing, double angle_of_repose, std::uint64_t seed,
             double roughening = 1);

  /// A bed over a periodic map of elevations [m], in the order of the geometry's cells, with so many columns
  /// along each edge of a cell. Heights are in layers above the mean elevation: within two layers of the
  /// surface, linear between the centres of cells, and of its volume to half a grain. Where the surface is
  /// steeper than repose the bed is at repose. Throws Error naming what is not allowed.
  static LatticeBed from_elevation(const GridGeometry& geometry, const std::vector<double>& elevation,
                                   int columns_per_cell, double angle_of_repose, std::uint64_t seed);

  int nx() const { return nx_; }
  int ny() const { return ny_; }
  double spacing() const { return spacing_; }
  double layer() const { return layer_; }  ///< height of a layer [m]
  double grain_volume() const { return 2 * layer_ * spacing_ * spacing_; }
  const std::vector<std::int16_t>& heights() const { return height_; }  ///< layers, row by row, x fastest
  /// Ejections so far.
  std::uint64_t ejections() const { return ejections_; }
  /// Sum of all heights, in layers: constant.
  std::int64_t total() const;

  /// Moves the bed forward. The number of ejections per area and time is `forcing.erosion_rate() /
  /// grain_volume * area`, so that the depth set moving per time is that of the forcing whatever the lattice
  /// spacing.
  void advance(const Forcing& forcing, double duration);

  /// Mean height of the columns in each cell [m] of a grid laid over the lattice from its corner at (0, 0).
  HeightMap::Layer elevation(const GridGeometry& geometry) const;

 private:
  struct Column;
  struct Path;
  struct Hop;
  struct Block;

  std::size_t index(Column at) const;
  void compare_neighbours();
  template <int layers>
  void change(Column at);
  template <bool up>
  Column walk(Column at, std::uint32_t& ways) const;
  Column anywhere();
  void roughen(double moves_per_column);
  void settle(std::int64_t grains);
  Path wind_path(double direction);
  void sweep(const Path& path, double drop, double gap, const Hop& hop);
  void eject(Column struck, const EjectionDraws::Draw& draw, const Hop& hop);

  int nx_;
  int ny_;
  double spacing_;
  double layer_;
  RandomStream random_;
  EjectionDraws draws_;
  std::vector<std::int16_t> height_;
  std::vector<std::uint8_t> higher_;  ///< which neighbours of a column are: east 1, west 2, north 4, south 8
  std::uint64_t ejections_ = 0;
};

}  // namespace aeolian
