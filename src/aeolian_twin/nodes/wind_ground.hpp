#pragma once

#include "aeolian_core/surface/height_map.hpp"

namespace aeolian {

/// The ground over which heights of anemometers and probes are meant: the elevation of a map without what is
/// roughness to the wind.
class WindGround {
 public:
  /// What is shorter than `shortest` [m], or four cells, is roughness.
  explicit WindGround(double shortest) : shortest_(shortest) {}

  /// Throws Error for a map without elevation.
  void take(const HeightMap& map);
  /// Its elevation; null as long as no cell is known.
  const HeightMap* map() const { return known_ ? &map_ : nullptr; }
  /// Of the map that was taken, which may know nothing; of size zero before.
  const GridGeometry& extent() const { return extent_; }
  bool is_known(double x, double y) const;
  /// Elevation about a place [m]; the mean of the map where it knows nothing, zero without any map.
  double at(double x, double y) const;

 private:
  double shortest_;
  GridGeometry extent_;
  bool known_ = false;
  HeightMap map_;
  double mean_ = 0;  ///< [m]
};

}  // namespace aeolian
