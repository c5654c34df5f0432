#pragma once

#include <limits>
#include <list>
#include <string>
#include <utility>
#include <vector>

#include "aeolian_core/surface/grid_geometry.hpp"

namespace aeolian {

/// Names of the standard layers. A layer that a scene lacks is absent, not filled with zeros.
namespace layer {
inline const std::string elevation = "elevation";  ///< [m]
inline const std::string variance = "variance";    ///< of the elevation [m^2]
inline const std::string ground = "ground";        ///< hard floor that the wind cannot move [m]
inline const std::string age = "age";              ///< since the last change [s]
inline const std::string coarse_fraction =
    "coarse_fraction";                             ///< of the volume of the surface's grains, 0 to 1
inline const std::string roughness = "roughness";  ///< rms height of what the cells do not resolve [m]
}  // namespace layer

/// A grid with named layers of floats, NaN where nothing is known.
///
///     HeightMap map(GridGeometry(0, 0, 0.002, 500, 250));
///     map.add(layer::elevation, 0);
///     map.layer(layer::elevation)[map.geometry().index(3, 4)] = 0.001F;
class HeightMap {
 public:
  using Layer = std::vector<float>;
  static constexpr float unknown = std::numeric_limits<float>::quiet_NaN();

  HeightMap() = default;
  explicit HeightMap(const GridGeometry& geometry) : geometry_(geometry) {}

  const GridGeometry& geometry() const { return geometry_; }
  bool has(const std::string& name) const;
  /// Names in the order in which the layers were added.
  std::vector<std::string> names() const;
  /// Throws Error that names the layer when it is absent.
  Layer& layer(const std::string& name);
  const Layer& layer(const std::string& name) const;
  /// Adds a layer filled with one value, or resets it to that value. References to other layers stay valid.
  Layer& add(const std::string& name, float value = unknown);
  /// Adds or replaces a layer; throws Error unless there is a value for each cell.
  Layer& add(const std::string& name, Layer values);
  void remove(const std::string& name);

 private:
  GridGeometry geometry_;
  std::list<std::pair<std::string, Layer>> layers_;  ///< a list, so that references to layers stay valid
};

/// The number of finite cells of a layer.
std::size_t count_known(const HeightMap::Layer& values);

/// A copy of a layer in which every unknown cell has the distance-weighted mean of the nearest known cells
/// along its row and column; a layer without any known cell becomes zero. Known cells are unchanged.
HeightMap::Layer filled(const GridGeometry& geometry, const HeightMap::Layer& values);

}  // namespace aeolian
