#include "aeolian_core/bedforms/erosion/snow_cover.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/bedforms/erosion/drift_laws.hpp"

namespace aeolian {
namespace {

const Atmosphere cold_air{1.3, 1.3e-5, 9.81};

double threshold(const SnowBonding& snow, double age) {
  return lifting_threshold(drifting_snow(), cold_air, 3e-4 * bond_cohesion(snow, bond_degree(snow, age)));
}

ErodibleBed level_bed(double depth) {
  HeightMap map(GridGeometry(0, 0, 0.05, 8, 8));
  map.add(layer::elevation, static_cast<float>(depth));
  map.add(layer::ground, 0);
  return ErodibleBed(map, 2e-4, true);
}

TEST(SnowBonding, thresholds_span_those_measured_over_natural_snow) {
  // Clifton, Ruedi & Lehning (2006): 0.27 to 0.69 m/s.
  const SnowBonding snow;
  EXPECT_NEAR(threshold(snow, 0), 0.27, 0.01);
  EXPECT_NEAR(threshold(snow, 2 * 86400), 0.69, 0.01);
  EXPECT_LT(threshold(snow, 600), threshold(snow, 3600));
}

TEST(SnowBonding, warm_snow_bonds_faster_and_none_takes_longer_than_a_day) {
  SnowBonding snow;
  snow.temperature = -40;
  EXPECT_EQ(bonding_time(snow), 24 * 3600);
  snow.temperature = -2;
  const double warm = bonding_time(snow);
  EXPECT_LT(warm, 0.3 * 24 * 3600);
  snow.temperature = -10;
  EXPECT_GT(bonding_time(snow), warm);
}

TEST(SnowCover, sinters_within_a_day_unless_fresh_snow_comes_down) {
  ErodibleBed bed = level_bed(0.01);
  SnowBonding snow;
  snow.temperature = -20;
  SnowCover cover(snow, bed);
  cover.advance(bed, 23 * 3600, 200);
  EXPECT_GT(bed.loose(0), 0);
  cover.deposited(5, 100 * ErodibleBed::parcel_units);
  cover.advance(bed, 2 * 3600, 200);
  EXPECT_EQ(bed.loose(0), 0);
  EXPECT_GT(bed.sintered(0), 0);
  EXPECT_GT(bed.loose(5), 0);
}

TEST(SnowCover, snowfall_adds_what_falls) {
  ErodibleBed bed = level_bed(0.01);
  SnowBonding snow;
  snow.snowfall = 1e-3;
  SnowCover cover(snow, bed);
  const std::int64_t before = bed.total_units();
  std::int64_t fallen = 0;
  for (int n = 0; n < 100; ++n) fallen += cover.advance(bed, 7, 200);
  EXPECT_EQ(bed.total_units() - before, fallen);
  const double depth = static_cast<double>(fallen) * bed.unit() / 64;
  EXPECT_NEAR(depth, 1e-3 * 700 / 200, bed.unit());
}

TEST(SnowCover, what_melts_stays_where_it_is_for_good) {
  ErodibleBed bed = level_bed(0.01);
  const std::int64_t before = bed.total_units();
  const double height = bed.elevation(7);
  SnowBonding snow;
  snow.temperature = 0.5;
  SnowCover cover(snow, bed);
  cover.advance(bed, 1, 200);
  EXPECT_FALSE(bed.covered(7));
  EXPECT_EQ(bed.total_units(), before);
  EXPECT_NEAR(bed.elevation(7), height, 1e-12);
}

}  // namespace
}  // namespace aeolian
