#include "aeolian_core/twin/bed_movement.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

constexpr double wavelength = 0.08;
constexpr double amplitude = 0.002;

/// Ripples across x that have gone on by `shift` [m].
HeightMap ripples(double shift) {
  const GridGeometry plot(0, 0, 0.002, 200, 40);
  HeightMap map(plot);
  HeightMap::Layer& z = map.add(layer::elevation, 0.0F);
  for (std::size_t i = 0; i < z.size(); ++i)
    z[i] =
        static_cast<float>(amplitude * std::sin(2 * M_PI * (plot.x(plot.cell_at(i).x) - shift) / wavelength));
  return map;
}

TEST(BedMovement, OfRipplesThatGoOnIsThatOfTwoSines) {
  // a sin(x) - a sin(x - d) has an amplitude of 2 a sin(d / 2); the mean of four cells keeps 0.984 of it.
  const double phase = 2 * M_PI * 0.01 / wavelength;
  const double kept = std::sin(M_PI * 0.008 / wavelength) / (4 * std::sin(M_PI * 0.002 / wavelength));
  EXPECT_NEAR(rms_movement(ripples(0), ripples(0.01)), kept * M_SQRT2 * amplitude * std::sin(phase / 2),
              1e-7);
  EXPECT_EQ(rms_movement(ripples(0), ripples(0)), 0);
}

TEST(BedMovement, CountsNoiseOfCellsByTheMeanOfASquare) {
  HeightMap noisy = ripples(0);
  RandomStream random(1, 1);
  for (float& z : noisy.layer(layer::elevation)) z += static_cast<float>(0.0004 * random.normal());
  EXPECT_NEAR(rms_movement(ripples(0), noisy), 0.0001, 0.00001);  // of 16 cells
}

TEST(BedMovement, LeavesOutWhatIsUnknown) {
  HeightMap half = ripples(0);
  HeightMap::Layer& z = half.layer(layer::elevation);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] = i < z.size() / 2 ? z[i] + 0.001F : HeightMap::unknown;
  EXPECT_NEAR(rms_movement(ripples(0), half), 0.001, 1e-8);
  half.layer(layer::elevation).assign(z.size(), HeightMap::unknown);
  EXPECT_EQ(rms_movement(ripples(0), half), 0);
}

TEST(BedMovement, OfHalfOfTheSquaresIsThatOfASine) {
  // Half of the time a sine is beyond 1 / sqrt(2) of its amplitude.
  const double phase = 2 * M_PI * 0.01 / wavelength;
  const double kept = std::sin(M_PI * 0.008 / wavelength) / (4 * std::sin(M_PI * 0.002 / wavelength));
  EXPECT_NEAR(median_movement(ripples(0), ripples(0.01)), kept * M_SQRT2 * amplitude * std::sin(phase / 2),
              0.1 * amplitude);
  EXPECT_EQ(median_movement(ripples(0), ripples(0)), 0);
}

TEST(BedMovement, OfHalfOfTheSquaresDoesNotCountFootprintsAndALiftedSensor) {
  HeightMap lifted = ripples(0);
  HeightMap::Layer& z = lifted.layer(layer::elevation);
  for (std::size_t i = 0; i < z.size(); ++i) z[i] += i < z.size() / 4 ? -0.02F : 0.01F;
  EXPECT_NEAR(median_movement(ripples(0), lifted), 0, 1e-8);
  z.assign(z.size(), HeightMap::unknown);
  EXPECT_EQ(median_movement(ripples(0), lifted), 0);
}

TEST(BedMovement, MeanVarianceIsThatOfKnownCells) {
  HeightMap map = ripples(0);
  EXPECT_EQ(mean_variance(map), 0);
  HeightMap::Layer& variance = map.add(layer::variance, 4e-8F);
  variance[3] = HeightMap::unknown;
  EXPECT_NEAR(mean_variance(map), 4e-8, 1e-13);
  variance.assign(variance.size(), HeightMap::unknown);
  EXPECT_EQ(mean_variance(map), 0);
}

}  // namespace
}  // namespace aeolian
