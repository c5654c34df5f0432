#pragma once

#include "../relief_worlds.hpp"

#include "aeolian_core/wind/sph/mean_air.hpp"

namespace aeolian::sph {

/// A box of air, a metre to a spacing, with its origin in the middle of a map of as many metres.
struct AirBox {
  WindRelief relief;
  BoxPlace place;

  AirBox(const HeightMap& map, int nx, int ny, int nz, float ring_x, float ring_y)
      : relief(wind_relief(map, 0)) {
    place.x = -0.5 * nx;
    place.y = -0.5 * ny;
    place.floor = *std::min_element(relief.height.begin(), relief.height.end());
    place.nx = nx;
    place.ny = ny;
    place.nz = nz;
    place.ring_x = ring_x;
    place.ring_y = ring_y;
    place.blend_x = place.blend_y = 3;
  }
  SphAir air(const Upwind& upwind = {}, const AirSettings& settings = {}) const {
    return SphAir(AirGround(relief, place), upwind, settings);
  }
};

inline AirBox level_box(int n, int nz) {
  return AirBox(world(n, n, 1, [](double, double) { return 0.0; }), n, n, nz, 3, 3);
}
inline double mean(const std::vector<float>& values) {
  double sum = 0;
  for (const float v : values) sum += static_cast<double>(v);
  return sum / static_cast<double>(values.size());
}
inline double deviation(const std::vector<float>& values) {
  const double middle = mean(values);
  double sum = 0;
  for (const float v : values) sum += (static_cast<double>(v) - middle) * (static_cast<double>(v) - middle);
  return std::sqrt(sum / static_cast<double>(values.size()));
}

/// Of each layer a spacing high.
inline std::vector<float> layer_means(const SphAir& air, const std::vector<float>& values) {
  const auto layers = static_cast<std::size_t>(air.torus().height);
  std::vector<float> sum(layers, 0), count(layers, 0);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const std::size_t layer = std::min(static_cast<std::size_t>(air.place()[i][2]), layers - 1);
    sum[layer] += values[i];
    ++count[layer];
  }
  for (std::size_t l = 0; l < layers; ++l) sum[l] /= count[l];
  return sum;
}

}  // namespace aeolian::sph
