#include "aeolian_core/wind/wall_law_response.hpp"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace aeolian {

TerrainResponse wall_law_response(const HeightMap& surface, const WindRelief& relief,
                                  const WindVolume& volume, double direction, const ReliefSettings& settings,
                                  double height) {
  const std::vector<std::uint8_t> separated = sheltered(relief, direction, settings.bubble).separated;
  const GridGeometry& g = relief.geometry;
  TerrainResponse response{g, HeightMap::Layer(g.size()), HeightMap::Layer(g.size()),
                           HeightMap::Layer(g.size())};
  const HeightMap::Layer& elevation = surface.layer(layer::elevation);
  height = std::max(height, 20 * settings.roughness);
  const double undisturbed = UpwindProfile::log_law(settings.roughness).speed(height);
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  tbb::parallel_for(0, g.ny(), [&](int y) {
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      if (!std::isfinite(elevation[i])) {
        response.friction[i] = response.deflection[i] = response.separated[i] = HeightMap::unknown;
      } else if (!separated.empty() && separated[i]) {
        response.separated[i] = 1;
      } else {
        const AirVelocity wind = volume.velocity(g.x(x), g.y(y), height);
        response.friction[i] = static_cast<float>(std::hypot(wind.east, wind.north) / undisturbed);
        response.deflection[i] =
            static_cast<float>(std::atan2(c * wind.north - s * wind.east, c * wind.east + s * wind.north));
      }
    }
  });
  return response;
}

}  // namespace aeolian
