#include <gtest/gtest.h>

#include "aeolian_core/bedforms/erosion/surface_patch.hpp"

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

}  // namespace
}  // namespace aeolian
