#include "aeolian_core/bedforms/erosion/half_excess_slides.hpp"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr double cell = 0.01;
constexpr double parcel = 1.5e-4;
const double tan_repose = std::tan(34 * M_PI / 180);

HeightMap map_of(int n, const std::function<double(int, int)>& height, double ground = -1) {
  HeightMap map(GridGeometry(0, 0, cell, n, n));
  HeightMap::Layer& elevation = map.add(layer::elevation, 0);
  map.add(layer::ground, static_cast<float>(ground));
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) elevation[map.geometry().index(x, y)] = static_cast<float>(height(x, y));
  return map;
}

std::int64_t settle(ErodibleBed& bed, int sweeps = 20000) {
  return slide(bed, tan_repose, sweeps, [](std::size_t, std::int32_t) {});
}

TEST(HalfExcessSlides, a_steep_cone_comes_to_rest_at_repose) {
  constexpr int n = 81;
  constexpr int middle = n / 2;
  ErodibleBed bed(
      map_of(n, [](int x,
                   int y) { return std::max(0.0, 0.3 - 1.5 * cell * std::hypot(x - middle, y - middle)); }),
      parcel, false);
  const std::int64_t before = bed.total_units();
  EXPECT_GT(settle(bed), 0);
  EXPECT_EQ(bed.total_units(), before);
  for (int k = 3; k < 15; ++k) {
    const double along = (bed.height(middle + k, middle) - bed.height(middle + k + 1, middle)) / cell;
    EXPECT_NEAR(std::atan(along) * 180 / M_PI, 34, 1) << k;
  }
  // The bed is a mirror of itself, to the last unit.
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const GridGeometry& g = bed.geometry();
      ASSERT_EQ(bed.loose(g.index(x, y)), bed.loose(g.index(n - 1 - x, y)));
      ASSERT_EQ(bed.loose(g.index(x, y)), bed.loose(g.index(x, n - 1 - y)));
      ASSERT_EQ(bed.loose(g.index(x, y)), bed.loose(g.index(y, x)));
    }
}

TEST(HalfExcessSlides, a_uniform_steep_slope_slides_and_a_gentle_one_does_not) {
  ErodibleBed steep(map_of(32, [](int x, int) { return 0.9 * cell * x; }), parcel, false);
  EXPECT_GT(settle(steep), 0);
  ErodibleBed gentle(map_of(32, [](int x, int) { return 0.6 * cell * x; }), parcel, false);
  EXPECT_EQ(settle(gentle), 0);
}

TEST(HalfExcessSlides, hard_ground_does_not_slide) {
  // A wall of rock, a grain's depth of sand on it.
  const auto height = [](int x, int) { return x < 16 ? 1.0 + 2e-4 : 2e-4; };
  HeightMap map = map_of(32, height);
  HeightMap::Layer& ground = map.layer(layer::ground);
  for (std::size_t i = 0; i < ground.size(); ++i) ground[i] = map.layer(layer::elevation)[i] - 2e-4F;
  ErodibleBed bed(map, parcel, false);
  const std::int64_t before = bed.total_units();
  settle(bed);
  EXPECT_EQ(bed.total_units(), before);
  EXPECT_NEAR(bed.elevation(bed.geometry().index(15, 16)), 1, 1e-4);
  for (std::size_t i = 0; i < ground.size(); ++i) {
    ASSERT_GE(bed.loose(i), 0);
    ASSERT_GE(bed.elevation(i), static_cast<double>(ground[i]));
  }
}

TEST(HalfExcessSlides, a_pit_between_many_slopes_is_not_raised_above_them) {
  ErodibleBed bed(map_of(9, [](int x, int y) { return x == 4 && y == 4 ? 0.0 : 0.1; }), parcel, true);
  settle(bed, 1);
  EXPECT_LE(bed.height(4, 4), bed.height(3, 4) + 1e-6F);
}

TEST(HalfExcessSlides, only_what_has_changed_is_looked_at) {
  ErodibleBed bed(map_of(64, [](int, int) { return 0.0; }), parcel, true);
  EXPECT_EQ(settle(bed), 0);
  EXPECT_TRUE(bed.dirty_tiles().empty());
  bed.add_loose(CellIndex{40, 40}, 200 * ErodibleBed::parcel_units);
  EXPECT_EQ(bed.dirty_tiles().count(), 1);
  EXPECT_GT(settle(bed), 0);
}

}  // namespace
}  // namespace aeolian
