#include "aeolian_core/twin/on_grid.hpp"

#include <cmath>

#include "aeolian_core/surface/resample.hpp"

namespace aeolian {

HeightMap on_grid(const HeightMap& map, const GridGeometry& target) {
  const GridGeometry& own = map.geometry();
  const double slack = 1e-6 * target.cell();
  const bool same = own.nx() == target.nx() && own.ny() == target.ny() &&
                    std::abs(own.length_x() - target.length_x()) < slack &&
                    std::abs(own.origin_x() - target.origin_x()) < slack &&
                    std::abs(own.origin_y() - target.origin_y()) < slack;
  if (!same) return resample(map, target);
  HeightMap result(target);
  for (const std::string& name : map.names()) result.add(name, map.layer(name));
  return result;
}

}  // namespace aeolian
