#include "aeolian_core/measure/sensor_noise.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/measure/fusion.hpp"
#include "aeolian_core/measure/point_locator.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {
namespace {

// Nguyen, Izadi & Lovell (2012): 0.0012 + 0.0019 (z - 0.4)^2 m.
TEST(SensorNoise, IsThePolynomialOfTheKinect) {
  SensorNoise kinect;
  kinect.range_sigma = 0.001504;
  kinect.range_sigma_per_metre = -0.00152;
  kinect.range_sigma_per_square_metre = 0.0019;
  for (const double z : {0.4, 1.0, 2.0, 3.0})
    EXPECT_NEAR(kinect.along_ray(z, 1), 0.0012 + 0.0019 * (z - 0.4) * (z - 0.4), 1e-12);
  kinect.min_range = 0.4;
  kinect.max_range = 4;
  EXPECT_NO_THROW(kinect.require_valid());
}

// A ray that meets a level bed under 60 degrees, drawn many times with errors along and across it.
TEST(SensorNoise, IsTheScatterOfHeightsOfSlantedRays) {
  SensorNoise noise;
  noise.range_sigma = 0.002;
  noise.angular_sigma = 0.001;
  noise.incidence_growth = 1;
  const double angle = M_PI / 3;
  const double range = 3;
  RandomStream random(1, 0);
  double sum = 0;
  const int count = 200000;
  const double m = SensorNoise::bed_slope;
  for (int i = 0; i < count; ++i) {
    const double along = noise.range_sigma * 2 * random.normal();  // 1 / cos 60
    const double across = range * noise.angular_sigma * random.normal();
    const double slope = (i % 2 == 0 ? m : -m);  // rms m, independent of the error
    const double z = along * std::cos(angle) - slope * along * std::sin(angle) + across * std::sin(angle) +
                     slope * across * std::cos(angle);
    sum += z * z;
  }
  EXPECT_NEAR(sum / count / noise.height_variance(range, std::cos(angle)), 1, 0.02);
}

// The loops over arrays give what the formula gives.
TEST(SensorNoise, IsTheWeightOfEveryPoint) {
  PointLocator locator;
  locator.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};
  locator.offset = {5, 5, 1.5};
  locator.per_cell = 10;
  locator.nx = locator.ny = 100;
  locator.tiles_x = 4;
  locator.farthest = 100;
  locator.noise.range_sigma_per_metre = 1e-4;
  locator.noise.range_sigma_per_square_metre = 2e-4;
  locator.noise.angular_sigma = 2e-4;
  locator.noise.incidence_growth = 0.5;
  RandomStream random(4, 0);
  std::array<std::array<float, PointLocator::batch>, 3> p{};
  for (auto& axis : p)
    for (float& v : axis) v = static_cast<float>(0.2 + 3 * random.uniform());
  std::array<std::int32_t, PointLocator::batch> tile{};
  std::array<Sample, PointLocator::batch> sample{};
  const PointCounts counts =
      locator.locate(p[0].data(), p[1].data(), p[2].data(), PointLocator::batch, tile.data(), sample.data());
  EXPECT_EQ(counts.used, PointLocator::batch);
  for (std::size_t i = 0; i < PointLocator::batch; ++i) {
    const double x = static_cast<double>(p[0][i]);
    const double y = static_cast<double>(p[1][i]);
    const double z = static_cast<double>(p[2][i]);
    const double range = std::sqrt(x * x + y * y + z * z);
    const double weight = fixed::reference_weight * 1e-6 / locator.noise.height_variance(range, z / range);
    EXPECT_NEAR(sample[i].weight(), weight, 0.51 + 1e-5 * weight);
    EXPECT_NEAR(fixed::metres(sample[i].height()), 1.5 - z, 0.51 * fixed::step);
    const int ix = static_cast<int>((5 + x) * 10);
    const int iy = static_cast<int>((5 - y) * 10);
    EXPECT_EQ(tile[i], iy / 32 * 4 + ix / 32);
    EXPECT_EQ(sample[i].cell(), static_cast<std::uint32_t>(iy % 32 * 32 + ix % 32));
  }
}

TEST(SensorNoise, NamesABadMember) {
  const auto message = [](const SensorNoise& noise) { return error_of([&] { noise.require_valid(); }); };
  SensorNoise noise;
  EXPECT_NO_THROW(noise.require_valid());
  noise.range_sigma_per_metre = -0.001;
  EXPECT_NE(message(noise).find("range_sigma_per_metre"), std::string::npos);
  noise = {};
  noise.angular_sigma = NAN;
  EXPECT_NE(message(noise).find("angular_sigma"), std::string::npos);
  noise = {};
  noise.incidence_growth = -1;
  EXPECT_NE(message(noise).find("incidence_growth"), std::string::npos);
  noise = {};
  noise.max_range = noise.min_range;
  EXPECT_NE(message(noise).find("max_range"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
