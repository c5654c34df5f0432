#pragma once

#include <cmath>

#include "accuracy_table.hpp"

#include "aeolian_core/bedforms/erosion/particle_erosion.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {

void erosion_golden_rows(AccuracyTable& table);
void erosion_thesis_rows(AccuracyTable& table);
void erosion_snow_rows(AccuracyTable& table);

/// Sand of 0.15 mm, repose 34 degrees.
inline Grain thesis_sand() {
  Grain grain;
  grain.diameter = 1.5e-4;
  grain.angle_of_repose = 34 * M_PI / 180;
  return grain;
}

/// The wind of a speed [m/s] at 10 m over ground of a roughness [m].
inline WindField wind_at_ten_metres(double speed, double roughness = 5e-6) {
  WindField wind;
  wind.friction_velocity = friction_velocity(speed, 10, roughness);
  return wind;
}

/// A layer `elevation` a depth [m] above the layer `ground`, uneven by a grain of 0.15 mm.
inline void lay_sand(HeightMap& map, double depth, std::uint64_t seed) {
  RandomStream random(seed, 0);
  const HeightMap::Layer& ground = map.layer(layer::ground);
  HeightMap::Layer& elevation = map.add(layer::elevation, 0);
  for (std::size_t i = 0; i < ground.size(); ++i)
    elevation[i] = ground[i] + static_cast<float>(depth + 1.5e-4 * (2 * random.uniform() - 1));
}

}  // namespace aeolian
