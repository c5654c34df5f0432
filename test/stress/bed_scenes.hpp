#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <fmt/format.h>

#include "aeolian_core/bedforms/bed_model.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

/// A bed, a wind and a time that nobody would choose, drawn at random.
struct BedScene {
  HeightMap map;
  Forcing forcing;
  double duration = 0;  ///< [s]

  std::string told() const {
    const GridGeometry& g = map.geometry();
    return fmt::format(
        "{} x {} cells of {:g} m{}, wind to {:.0f} deg, d {:g} m, K0 {:g} m/s, hops {:g} m at {:.2f} rad, "
        "{:g} s",
        g.nx(), g.ny(), g.cell(), map.has(layer::ground) ? " on ground" : "", forcing.direction * 180 / M_PI,
        forcing.grain.diameter, forcing.erosion_rate(), forcing.reptation_length, forcing.impact_angle,
        duration);
  }
};

struct SceneKind {
  bool holes = false;
  bool ground = false;
};

/// Cells of a grain to a metre, noise, spikes, pits, cliffs, waves; sand of 0.1 to 2 mm; winds from the
/// threshold to a gale from anywhere; times of 1 ms to 12 days, at most some 200 steps.
inline BedScene draw_scene(std::uint64_t seed, const SceneKind& kind) {
  RandomStream random(seed, 0);
  const auto between = [&](double low, double high) { return low + (high - low) * random.uniform(); };
  const auto log_between = [&](double low, double high) {
    return low * std::pow(high / low, random.uniform());
  };
  const auto chance = [&](double share) { return random.uniform() < share; };

  BedScene scene;
  Grain& grain = scene.forcing.grain;
  grain.diameter = log_between(1e-4, 2e-3);
  const double cell = log_between(grain.diameter, 1);
  const int nx = static_cast<int>(between(8, 90));
  const int ny = static_cast<int>(between(8, 90));
  scene.map = HeightMap(GridGeometry(between(-1e6, 1e6), between(-1e6, 1e6), cell, nx, ny));
  const double relief = cell * log_between(1e-3, 10);
  const double wave = between(2, 40);
  const double noise = chance(0.5) ? relief : 0;
  HeightMap::Layer& height = scene.map.add(layer::elevation, 0);
  for (int y = 0; y < ny; ++y)
    for (int x = 0; x < nx; ++x)
      height[scene.map.geometry().index(x, y)] =
          static_cast<float>(relief * std::sin(2 * M_PI * (x + 0.3 * y) / wave) + noise * random.normal());
  const auto anywhere = [&] {
    return static_cast<std::size_t>(random.uniform() * static_cast<double>(height.size()));
  };
  for (int n = 0; n < 5; ++n) {
    height[anywhere()] += static_cast<float>(100 * relief);
    height[anywhere()] -= static_cast<float>(100 * relief);
  }
  if (chance(0.3))  // a cliff
    for (std::size_t i = anywhere(); i < height.size(); ++i) height[i] += static_cast<float>(30 * relief);
  if (kind.ground) {
    HeightMap::Layer& ground = scene.map.add(layer::ground);
    for (std::size_t i = 0; i < height.size(); ++i)
      if (chance(0.9))
        ground[i] = height[i] - static_cast<float>(chance(0.5) ? 0 : relief * random.exponential());
  }
  if (kind.holes) {
    const double share = between(0.001, 0.7);
    for (float& h : height)
      if (chance(share)) h = HeightMap::unknown;
  }

  Forcing& forcing = scene.forcing;
  forcing.direction = between(-M_PI, M_PI);
  forcing.friction_velocity = log_between(0.2, 2);
  forcing.impact_angle = log_between(0.02, 1.4);
  forcing.reptation_length = log_between(grain.diameter, std::clamp(20 * cell, 2 * grain.diameter, 0.2));
  const double side = grain.effective_diameter();
  const double erosion = log_between(1e-7, 1e-2);
  forcing.ejection_rate = erosion / (side * side * side);
  const double steps_per_second = erosion / (cell * std::tan(forcing.impact_angle));
  scene.duration = std::min(log_between(1e-3, 1e6), 200 / steps_per_second);
  return scene;
}

}  // namespace aeolian
