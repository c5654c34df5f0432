#include "aeolian_core/surface/grid_geometry.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

GridGeometry::GridGeometry(double origin_x, double origin_y, double cell, int nx, int ny)
    : origin_x_(origin_x), origin_y_(origin_y), cell_(cell), nx_(nx), ny_(ny) {
  if (!std::isfinite(origin_x) || !std::isfinite(origin_y)) throw Error("grid: the origin must be finite");
  if (!(cell > 0) || !std::isfinite(cell))
    throw Error("grid: cell size is " + std::to_string(cell) + " m, must be positive");
  const bool countable = nx >= 1 && ny >= 1 && nx <= std::numeric_limits<int>::max() / ny;
  if (!countable)
    throw Error("grid: " + std::to_string(nx) + " x " + std::to_string(ny) +
                " cells, must be at least 1 x 1 and fewer than 2^31 in all");
}

GridGeometry GridGeometry::covering(double min_x, double min_y, double max_x, double max_y, double cell) {
  if (!(min_x <= max_x && min_y <= max_y) || !(cell > 0)) throw Error("grid: the bounds to cover are empty");
  // A corner within a millionth of a cell of an edge is taken to lie on it: 0.3 / 0.1 must give 3 cells.
  const double slack = 1e-6;
  const double x0 = std::floor(min_x / cell + slack);
  const double y0 = std::floor(min_y / cell + slack);
  const double nx = std::max(1.0, std::ceil(max_x / cell - slack) - x0);
  const double ny = std::max(1.0, std::ceil(max_y / cell - slack) - y0);
  if (!(nx * ny < static_cast<double>(std::numeric_limits<int>::max())))
    throw Error("grid: cells of " + std::to_string(cell) + " m are too small for an extent of " +
                std::to_string(max_x - min_x) + " x " + std::to_string(max_y - min_y) + " m");
  return {x0 * cell, y0 * cell, cell, static_cast<int>(nx), static_cast<int>(ny)};
}

}  // namespace aeolian
