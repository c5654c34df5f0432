#include "aeolian_core/bedforms/lattice/kept_surface.hpp"

#include "aeolian_core/surface/error.hpp"

namespace aeolian {

void check_all_sand(const std::string& model, const HeightMap& map) {
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  if (const std::size_t known = count_known(elevation); known != elevation.size())
    throw Error(model + ": " + std::to_string(elevation.size() - known) + " of " +
                std::to_string(elevation.size()) +
                " cells of the layer elevation are unknown, all must be known");
  if (map.has(layer::ground)) throw Error(model + ": the map has a layer ground, must be sand all through");
}

bool KeptSurface::take(const HeightMap& map) {
  const HeightMap::Layer& elevation = map.layer(layer::elevation);
  if (map.geometry() == geometry_ && elevation == stored_) return false;
  geometry_ = map.geometry();
  height_.assign(elevation.begin(), elevation.end());
  stored_ = elevation;
  owed_ = 0;
  return true;
}

BedChange KeptSurface::store(const std::vector<double>& change, double moved, HeightMap& map) {
  const double area = geometry_.cell() * geometry_.cell();
  BedChange result{TileMask(geometry_), {}};
  result.volume.moved = moved;
  HeightMap::Layer& elevation = map.layer(layer::elevation);
  for (int y = 0; y < geometry_.ny(); ++y)
    for (int x = 0; x < geometry_.nx(); ++x) {
      const std::size_t i = geometry_.index(x, y);
      if (change[i] == 0) continue;
      result.volume.change += change[i] * area;
      result.active.activate(x, y);
      owed_ -= height_[i] - static_cast<double>(elevation[i]);
      height_[i] += change[i];
      elevation[i] = static_cast<float>(height_[i] + owed_);
      owed_ += height_[i] - static_cast<double>(elevation[i]);
    }
  stored_ = elevation;
  return result;
}

}  // namespace aeolian
