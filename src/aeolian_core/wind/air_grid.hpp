#pragma once

#include <vector>

#include "aeolian_core/wind/wind_relief.hpp"

namespace aeolian {

/// Boxes of air over a relief, some of them cut by the ground, some within it: over the map square and as
/// high as each other from the lowest ground to the highest, beyond the map and above it ever greater, so
/// that what is far away disturbs nothing.
class AirGrid {
 public:
  /// At most about `max_boxes`, at least 1000; the map's cells are joined until that is so.
  AirGrid(const WindRelief& relief, std::size_t max_boxes);

  int nx() const { return static_cast<int>(x_.size()) - 1; }
  int ny() const { return static_cast<int>(y_.size()) - 1; }
  int nz() const { return static_cast<int>(z_.size()) - 1; }
  /// Borders of the boxes along each axis [m], in the frame of the map and heights of the relief.
  const std::vector<double>& x() const { return x_; }
  const std::vector<double>& y() const { return y_; }
  const std::vector<double>& z() const { return z_; }
  /// A map of one row or column: the wind cannot give way across it.
  bool thin_x() const { return thin_x_; }
  bool thin_y() const { return thin_y_; }
  /// The ground under a point: bilinear, beyond the border that of the border [m].
  double ground(double x, double y) const;
  /// Heights of the ground at some places along the western and southern border of column (ix, iy) and in it.
  static constexpr int samples = 4;
  void western_edge(int ix, int iy, double* heights) const;   ///< `samples`
  void southern_edge(int ix, int iy, double* heights) const;  ///< `samples`
  void footprint(int ix, int iy, double* heights) const;      ///< `samples` squared
  /// How much of the heights between two borders is above the ground, 0 to 1.
  double open(const double* heights, int iz) const;

 private:
  const WindRelief& relief_;
  std::vector<double> x_, y_, z_;
  bool thin_x_, thin_y_;
};

}  // namespace aeolian
