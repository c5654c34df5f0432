#include "aeolian_core/bedforms/erosion/hop_walk.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/bedforms/erosion/surface_patch.hpp"
#include "aeolian_core/surface/random.hpp"
#include "aeolian_core/wind/log_law.hpp"

namespace aeolian {
namespace {

/// Level ground with a cliff along the wind, whose height nothing flies over.
ErodibleBed bed_with_a_cliff(bool periodic) {
  HeightMap map(GridGeometry(0, 0, 0.005, 100, 60));
  HeightMap::Layer& height = map.add(layer::elevation, 0);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 100; ++x) height[map.geometry().index(x, y)] = y < 6 ? 0.2F : 0.0F;
  return ErodibleBed(map, 1.5e-4, periodic);
}

TEST(ErodibleBed, no_place_is_above_the_height_of_its_block) {
  for (const bool periodic : {false, true}) {
    ErodibleBed bed = bed_with_a_cliff(periodic);
    bed.add_loose(CellIndex{8, 16}, 200 * ErodibleBed::parcel_units);
    bed.add_loose(CellIndex{0, 0}, 900 * ErodibleBed::parcel_units);
    for (float y = 0; y < bed.last_y(); y += 0.31F)
      for (float x = 0; x < bed.last_x(); x += 0.31F)
        ASSERT_LE(height_at(bed, x, y), bed.highest_of_block(static_cast<int>(x) / ErodibleBed::block_cells,
                                                             static_cast<int>(y) / ErodibleBed::block_cells))
            << x << " " << y;
  }
}

TEST(WalkHop, a_cliff_elsewhere_changes_nothing) {
  HeightMap map(GridGeometry(0, 0, 0.005, 100, 60));
  map.add(layer::elevation, 0);
  Grain sand;
  sand.diameter = 1.5e-4;
  const Atmosphere air{1.225, 1.5e-5, 9.81};
  const double friction = friction_velocity(12, 10, 5e-6);
  const HopTable table({friction, 5e-6, sand, air}, 4, 1.5);
  const Drift::Cell wind{static_cast<float>(friction), 1, 0};
  for (const bool periodic : {false, true}) {
    const ErodibleBed level(map, 1.5e-4, periodic);
    const ErodibleBed cliff = bed_with_a_cliff(periodic);
    RandomStream random(1, 0);
    for (int n = 0; n < 500; ++n) {
      const auto x = static_cast<float>(90 * random.uniform());
      const auto y = static_cast<float>(8 + 50 * random.uniform());
      const Eigen::Vector3f v(static_cast<float>(random.uniform()), 0, static_cast<float>(random.uniform()));
      const HopEnd a = walk_hop(level, table, wind, x, y, v);
      const HopEnd b = walk_hop(cliff, table, wind, x, y, v);
      ASSERT_EQ(a.outside, b.outside);
      if (a.outside) continue;  // how far beyond the border does not matter
      ASSERT_NEAR(a.way, b.way, 0.01F + 0.02F * a.way) << n;
    }
  }
}

}  // namespace
}  // namespace aeolian
