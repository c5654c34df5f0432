#pragma once

#include <cmath>
#include <cstddef>
#include <optional>

namespace aeolian {

/// Indices of a cell: x eastwards, y northwards, both from 0.
struct CellIndex {
  int x = 0;
  int y = 0;
  friend bool operator==(CellIndex a, CellIndex b) { return a.x == b.x && a.y == b.y; }
};

/// Where a grid of square cells lies in the map frame.
///
/// The origin is the outer corner of cell (0, 0), the one of smallest x and y [m]. It is a double, so that
/// UTM coordinates lose nothing. Cells are stored row by row, x fastest: index = y * nx + x.
class GridGeometry {
 public:
  GridGeometry() = default;
  /// Throws Error unless cell > 0, counts >= 1, all numbers are finite and the cells can be counted in an
  /// int.
  GridGeometry(double origin_x, double origin_y, double cell, int nx, int ny);
  /// The smallest grid of cells whose edges are multiples of `cell` that covers the given bounds [m].
  static GridGeometry covering(double min_x, double min_y, double max_x, double max_y, double cell);

  double origin_x() const { return origin_x_; }
  double origin_y() const { return origin_y_; }
  double cell() const { return cell_; }
  int nx() const { return nx_; }
  int ny() const { return ny_; }
  std::size_t size() const { return static_cast<std::size_t>(nx_) * static_cast<std::size_t>(ny_); }
  double length_x() const { return nx_ * cell_; }
  double length_y() const { return ny_ * cell_; }

  std::size_t index(int ix, int iy) const {
    return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx_) + static_cast<std::size_t>(ix);
  }
  std::size_t index(CellIndex c) const { return index(c.x, c.y); }
  CellIndex cell_at(std::size_t index) const {
    const auto nx = static_cast<std::size_t>(nx_);
    return {static_cast<int>(index % nx), static_cast<int>(index / nx)};
  }
  bool contains(CellIndex c) const { return c.x >= 0 && c.y >= 0 && c.x < nx_ && c.y < ny_; }

  /// Centre of a cell [m].
  double x(int ix) const { return origin_x_ + (ix + 0.5) * cell_; }
  double y(int iy) const { return origin_y_ + (iy + 0.5) * cell_; }
  /// The cell that holds a point, nothing outside the grid or for a coordinate that is not finite.
  std::optional<CellIndex> find(double px, double py) const {
    const double fx = std::floor((px - origin_x_) / cell_);
    const double fy = std::floor((py - origin_y_) / cell_);
    if (!(fx >= 0 && fy >= 0 && fx < nx_ && fy < ny_)) return std::nullopt;
    return CellIndex{static_cast<int>(fx), static_cast<int>(fy)};
  }

  friend bool operator==(const GridGeometry& a, const GridGeometry& b) {
    return a.origin_x_ == b.origin_x_ && a.origin_y_ == b.origin_y_ && a.cell_ == b.cell_ && a.nx_ == b.nx_ &&
           a.ny_ == b.ny_;
  }
  friend bool operator!=(const GridGeometry& a, const GridGeometry& b) { return !(a == b); }

 private:
  double origin_x_ = 0;
  double origin_y_ = 0;
  double cell_ = 1;
  int nx_ = 0;
  int ny_ = 0;
};

}  // namespace aeolian
