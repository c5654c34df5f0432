#include "aeolian_core/bedforms/erosion/spread.hpp"

#include <gtest/gtest.h>

namespace aeolian {
namespace {

ErodibleBed thin_bed(int nx, int ny, bool periodic) {
  HeightMap map(GridGeometry(0, 0, 0.01, nx, ny));
  map.add(layer::elevation, 1.6e-4F);  // a little more than a parcel
  map.add(layer::ground, 0);
  return ErodibleBed(map, 1.5e-4, periodic);
}

TEST(Spread, takes_and_gives_whole_numbers_that_add_up_at_every_border) {
  constexpr std::int32_t parcel = ErodibleBed::parcel_units;
  const auto silent = [](std::size_t, std::int32_t) {};
  for (const bool periodic : {false, true})
    for (const int nx : {1, 2, 7})
      for (const float x : {-0.49F, 0.0F, 0.3F, 0.5F, static_cast<float>(nx) - 0.51F})
        for (const float y : {-0.4F, 1.7F, 4.49F}) {
          if (periodic && (x < 0 || y < 0)) continue;
          ErodibleBed bed = thin_bed(nx, 5, periodic);
          const Spread spread(bed, x, y, true);
          for (int n = 0; n < 6; ++n) {
            const std::int64_t before = bed.total_units();
            const bool taken = spread.take_parcel(bed, parcel);
            EXPECT_EQ(before - bed.total_units(), taken ? parcel : 0) << nx << " " << x << " " << y;
          }
          const std::int64_t empty = bed.total_units();
          EXPECT_EQ(spread.give(bed, 4097, silent), 0);
          EXPECT_EQ(bed.total_units() - empty, 4097);
          const std::int32_t taken = spread.take_loose(bed, 100000);
          EXPECT_EQ(taken, empty + 4097 - bed.total_units());
          for (std::size_t i = 0; i < bed.geometry().size(); ++i) EXPECT_GE(bed.loose(i), 0);
        }
}

TEST(Spread, keeps_the_centre_of_mass) {
  ErodibleBed bed = thin_bed(8, 8, true);
  const std::int32_t before = bed.loose(0);
  Spread(bed, 3.25F, 4.75F, true).give(bed, 160000, [](std::size_t, std::int32_t) {});
  double x = 0, y = 0;
  for (std::size_t i = 0; i < bed.geometry().size(); ++i) {
    const CellIndex c = bed.geometry().cell_at(i);
    x += c.x * (bed.loose(i) - before) / 160000.0;
    y += c.y * (bed.loose(i) - before) / 160000.0;
  }
  EXPECT_NEAR(x, 3.25, 1e-4);
  EXPECT_NEAR(y, 4.75, 1e-4);
}

}  // namespace
}  // namespace aeolian
