#include "aeolian_core/twin/map_error.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// Mean product of a field with itself so many cells further on, over many fields.
double correlation(const GridGeometry& geometry, double length, int lag_x, int lag_y) {
  double sum = 0;
  int count = 0;
  for (std::uint64_t stream = 0; stream < 40; ++stream) {
    const HeightMap::Layer noise = smooth_noise(geometry, length, 5, stream);
    for (int y = 0; y + lag_y < geometry.ny(); ++y)
      for (int x = 0; x + lag_x < geometry.nx(); ++x, ++count)
        sum += static_cast<double>(noise[geometry.index(x, y)]) * noise[geometry.index(x + lag_x, y + lag_y)];
  }
  return sum / count;
}

TEST(MapError, HasItsVarianceAndItsLength) {
  const GridGeometry geometry(0, 0, 0.004, 120, 100);
  // The correlation of two cubic B-splines (the B-spline of seventh degree, as a share of its maximum).
  EXPECT_NEAR(correlation(geometry, 0.02, 0, 0), 1, 0.04);
  EXPECT_NEAR(correlation(geometry, 0.02, 5, 0), 1191.0 / 2416, 0.04);
  EXPECT_NEAR(correlation(geometry, 0.02, 0, 5), 1191.0 / 2416, 0.04);
  EXPECT_NEAR(correlation(geometry, 0.02, 10, 0), 120.0 / 2416, 0.04);
  EXPECT_NEAR(correlation(geometry, 0.02, 25, 0), 0, 0.04);
}

TEST(MapError, IsDecidedBySeedAndStream) {
  const GridGeometry geometry(0, 0, 0.004, 30, 20);
  EXPECT_EQ(smooth_noise(geometry, 0.02, 5, 9), smooth_noise(geometry, 0.02, 5, 9));
  EXPECT_NE(smooth_noise(geometry, 0.02, 5, 9), smooth_noise(geometry, 0.02, 5, 10));
  EXPECT_NE(smooth_noise(geometry, 0.02, 5, 9), smooth_noise(geometry, 0.02, 6, 9));
}

TEST(MapError, TakesAnyLength) {
  const GridGeometry geometry(0, 0, 0.01, 3, 1);
  for (const double length : {0.0, 1e-6, 0.02, 100.0})
    for (const float z : smooth_noise(geometry, length, 1, 1)) EXPECT_TRUE(std::isfinite(z)) << length;
}

}  // namespace
}  // namespace aeolian
