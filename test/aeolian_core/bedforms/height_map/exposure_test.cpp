#include "aeolian_core/bedforms/height_map/exposure.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

constexpr double cell = 0.002;
const double tan_alpha = std::tan(10 * M_PI / 180);
const double drop = cell * tan_alpha;

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

std::vector<double> open(const std::vector<double>& height, double inflow_height) {
  std::vector<double> exposure(height.size());
  exposure_open(height.data(), height.size(), drop, inflow_height, exposure.data());
  return exposure;
}

TEST(ExposureTest, flat_bed_receives_the_flat_bed_supply) {
  const std::vector<double> flat(100, 0.3);
  for (const double e : open(flat, 0.3)) EXPECT_NEAR(e, 1, 1e-12);
  std::vector<double> exposure(flat.size());
  exposure_periodic(flat.data(), flat.size(), drop, exposure.data());
  for (const double e : exposure) EXPECT_NEAR(e, 1, 1e-12);
}

TEST(ExposureTest, lit_planes_follow_werner_5_6) {
  for (const double slope : {-0.15, -0.05, 0.02, 0.2, 0.6}) {
    std::vector<double> plane(100);
    for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = slope * cell * static_cast<double>(i);
    const std::vector<double> exposure = open(plane, -slope * cell);
    for (std::size_t i = 0; i + 1 < exposure.size(); ++i)
      EXPECT_NEAR(exposure[i], 1 + slope / tan_alpha, 1e-12) << slope << " at " << i;
  }
}

TEST(ExposureTest, slopes_steeper_than_the_rain_are_dark) {
  std::vector<double> plane(100);
  for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = -0.3 * cell * static_cast<double>(i);
  for (const double e : open(plane, 0.3 * cell)) EXPECT_EQ(e, 0);
}

TEST(ExposureTest, a_step_casts_a_shadow_as_long_as_its_height_over_tan_alpha) {
  const double step = 0.01;
  std::vector<double> bed(200, 0.0);
  for (std::size_t i = 0; i < 50; ++i) bed[i] = step;
  const std::vector<double> exposure = open(bed, step);
  double dark = 0;
  for (std::size_t i = 50; i < 200; ++i) dark += exposure[i] == 0 ? cell : 0;
  EXPECT_NEAR(dark, step / tan_alpha, cell);
  // Whatever the shadow withholds is all that is missing: 50 lit cells and those behind the shadow.
  EXPECT_NEAR(sum(exposure), 200 - step / drop, 1e-9);
}

TEST(ExposureTest, supply_is_conserved_over_a_period_of_any_bed) {
  std::vector<double> bed(257);
  for (std::size_t i = 0; i < bed.size(); ++i)
    bed[i] = 0.004 * std::sin(0.31 * static_cast<double>(i * i % 97)) +
             0.01 * std::cos(0.05 * static_cast<double>(i));
  std::vector<double> exposure(bed.size());
  exposure_periodic(bed.data(), bed.size(), drop, exposure.data());
  EXPECT_NEAR(sum(exposure), 257, 257e-12);
  for (const double e : exposure) EXPECT_GE(e, 0);
}

TEST(ExposureTest, a_shadow_reaches_across_the_periodic_border) {
  std::vector<double> bed(100, 0.0);
  bed[95] = 0.005;  // 14 cells of shadow
  std::vector<double> exposure(bed.size());
  exposure_periodic(bed.data(), bed.size(), drop, exposure.data());
  for (std::size_t i = 0; i < 8; ++i) EXPECT_EQ(exposure[i], 0) << i;
  EXPECT_NEAR(exposure[20], 1, 1e-12);
}

TEST(ExposureTest, a_single_cell_is_a_flat_bed) {
  const double height = 3;
  double exposure = 0;
  exposure_periodic(&height, 1, drop, &exposure);
  EXPECT_NEAR(exposure, 1, 1e-9);
  exposure_open(&height, 1, drop, height, &exposure);
  EXPECT_NEAR(exposure, 1, 1e-9);
}

}  // namespace
}  // namespace aeolian
