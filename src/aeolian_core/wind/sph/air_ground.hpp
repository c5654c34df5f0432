#pragma once

#include <vector>

#include "aeolian_core/wind/sph/four.hpp"
#include "aeolian_core/wind/wind_relief.hpp"

namespace aeolian::sph {

/// Where a box of air stands over a relief. Lengths in the box are counted in particle spacings from its
/// south-western lower corner.
struct BoxPlace {
  double x = 0, y = 0;   ///< of that corner [m]
  double floor = 0;      ///< height of that corner [m], that of the relief
  double spacing = 1;    ///< of particles [m]
  int nx = 16, ny = 16;  ///< sites along each axis
  int nz = 16;           ///< from the floor to the lid
  float ring_x = 0;      ///< width of the ring of given wind along the borders across x; zero: it repeats
  float ring_y = 0;
  float blend_x = 1;  ///< width within the ring over which the relief sinks to the ring's level
  float blend_y = 1;
};

/// The ground under a box: the height grid itself, bilinear between its cells, asked where a particle is.
/// Within the ring it is level, at the mean of the relief's border, so that opposite borders of the box fit;
/// beyond the map it is that of its border.
class AirGround {
 public:
  AirGround(const WindRelief& relief, const BoxPlace& place);

  const BoxPlace& place() const { return place_; }
  /// Moves the box so that its corner is at x, y [m].
  void move(double x, double y);

  float height(float x, float y) const { return surface(x, y).z; }
  float level() const { return level_; }
  float highest() const { return highest_; }
  /// The nearest place of the ground: distance (negative within it) in the fourth place of `at`, unit normal
  /// in `normal`. What is farther than `reach` is only told to be so.
  void nearest(Four& at, Four& normal, float reach) const;

 private:
  struct Surface {
    float z, slope_x, slope_y;
  };
  Surface surface(float x, float y) const;
  Surface relief(float x, float y) const;
  struct Foot {
    float x, y, z;
    float slope_x, slope_y;
  };
  /// The foot of a perpendicular, sought from above (x, y).
  Foot foot(const Four& at, float x, float y, float reach) const;

  GridGeometry geometry_;
  BoxPlace place_;
  float level_ = 0;
  float highest_ = 0;
  float steepest_ = 0;
  float origin_x_ = 0, origin_y_ = 0;  ///< of the box' corner in cells of the map
  float cells_ = 1;                    ///< cells to a spacing
  std::vector<float> height_;          ///< the relief in spacings
};

}  // namespace aeolian::sph
