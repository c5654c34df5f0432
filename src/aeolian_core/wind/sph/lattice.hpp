#pragma once

#include <algorithm>

#include "aeolian_core/wind/sph/air_ground.hpp"
#include "aeolian_core/wind/sph/cell_order.hpp"

namespace aeolian::sph {

/// The sites of a box's air: over each square of a spacing a column of as many as fit between the ground and
/// the lid, evenly spaced; what rounding leaves goes on to the next column, so that their count is the volume
/// of the air.
std::vector<Four> lattice(const AirGround& ground);

/// The `count` sites with the least air around them, and the `count` particles with the most: where a box
/// that moves over relief gets and loses particles. `place` in the order of `cells`.
std::vector<std::size_t> emptiest(const CellOrder& cells, const std::vector<Four>& place,
                                  const std::vector<Four>& sites, std::size_t count, float support);
std::vector<std::size_t> fullest(const CellOrder& cells, const std::vector<Four>& place, std::size_t count,
                                 float support);

/// Calls visit(index, way) for every particle closer than a support to a point.
template <class Visit>
void for_near(const CellOrder& cells, const std::vector<Four>& place, const Four& at, float support,
              Visit&& visit) {
  const Torus& t = cells.torus();
  const auto c = static_cast<int>(cells.cell_of(at));
  const int cx = c % cells.nx();
  const int cy = c / cells.nx() % cells.ny();
  const int cz = c / (cells.nx() * cells.ny());
  for (int z = std::max(cz - 1, 0); z <= std::min(cz + 1, cells.nz() - 1); ++z)
    for (int y = cy - 1; y <= cy + 1; ++y)
      for (int x = cx - 1; x <= cx + 1; ++x) {
        const int wx = (x + cells.nx()) % cells.nx();
        const int wy = (y + cells.ny()) % cells.ny();
        const Four shift{x < 0             ? -t.length_x
                         : x >= cells.nx() ? t.length_x
                                           : 0,
                         y < 0             ? -t.length_y
                         : y >= cells.ny() ? t.length_y
                                           : 0,
                         0, 0};
        const std::size_t cell = cells.cell(wx, wy, z);
        for (std::size_t i = cells.first()[cell]; i < cells.first()[cell + 1]; ++i) {
          const Four way = place[i] + shift - at;
          if (dot3(way, way) < support * support) visit(i, way);
        }
      }
}

}  // namespace aeolian::sph
