#include "aeolian_core/wind/spectral_volume.hpp"

#include "relief_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

SpectralVolume potential_flow(const HeightMap& map, double direction, double top, bool periodic = false) {
  return SpectralVolume(wind_relief(map, 0, periodic), direction, UpwindProfile::uniform(), attached, top);
}

TEST(SpectralVolume, IsPotentialFlowOverAnAgnesiHill) {
  const double h = 0.2;
  for (const double cell : {1.0, 0.5}) {
    const double l = 20;
    const int n = static_cast<int>(1600 / cell) + 1;
    const SpectralVolume v =
        potential_flow(ridge(n, cell, [&](double x) { return agnesi(x, h, l); }), 0, 100);
    for (const double z : {0.0, 5.0, 20.0, 40.0})
      EXPECT_NEAR((v.velocity(0, 0, z + 0.01).east - 1) / (h / l), 1 / std::pow(1 + z / l, 2), 0.02);
    EXPECT_NEAR((v.velocity(1.73 * l, 0, 0.01).east - 1) / (h / l), -0.125, 0.02);
  }
}

TEST(SpectralVolume, LiftOverWavesDecaysAsTheyAreLong) {
  const double k = 2 * M_PI / 64;
  const SpectralVolume v =
      potential_flow(ridge(256, 1, [&](double x) { return 0.05 / k * std::cos(k * x); }), 0, 40, true);
  for (const double kz : {0.5, 1.0, 2.0}) {
    double most = 0;
    for (int x = -60; x < 4; ++x) most = std::max(most, v.velocity(x, 0, kz / k).up);
    EXPECT_NEAR(most, 0.05 * std::exp(-kz), 0.1 * 0.05 * std::exp(-kz));
  }
}

TEST(SpectralVolume, NoBoxGainsOrLosesAir) {
  const HeightMap map =
      world(60, 44, 2, [](double x, double y) { return gaussian(std::hypot(x - 9, y), 9, 16); });
  for (const UpwindProfile& upwind : {UpwindProfile::uniform(), UpwindProfile::log_law(1e-3)})
    for (int eighth = 0; eighth < 8; ++eighth) {
      const SpectralVolume v(wind_relief(map, 0), eighth * M_PI / 4, upwind, LeeBubble{}, 60);
      const int nz = v.flows().nz();
      for (const BoxRange& box :
           {BoxRange{0, 40, 0, 28, 0, nz}, {7, 21, 5, 26, 3, nz - 2}, {20, 21, 13, 14, 0, 1}}) {
        const FaceFlows::Balance b = v.flows().balance(box);
        EXPECT_GT(b.inflow, 0);
        EXPECT_LT(std::abs(b.net), 1e-6 * b.inflow);
      }
    }
}

TEST(SpectralVolume, FlatGroundHasTheLogLaw) {
  const SpectralVolume v(wind_relief(world(9, 9, 1, [](double, double) { return 7.0; }), 0), 0.5,
                         UpwindProfile::log_law(1e-4), LeeBubble{}, 20);
  for (const auto& [z, speed] : {std::pair{0.1, 5.181}, {1.0, 6.908}, {10.0, 8.635}}) {  // u* 0.3 m/s
    const AirVelocity wind = v.velocity(0, 0, z);
    EXPECT_NEAR(0.3 * std::hypot(wind.east, wind.north), speed, 1e-3 * speed);
    EXPECT_NEAR(std::atan2(wind.north, wind.east), 0.5, 1e-6);
    EXPECT_NEAR(wind.up, 0, 1e-6);
  }
  EXPECT_EQ(v.velocity(0, 0, 1e-4).east, 0);
  EXPECT_TRUE(std::isnan(v.velocity(100, 0, 1).east));
  EXPECT_TRUE(std::isnan(v.velocity(0, 0, 1e4).east));
}

TEST(SpectralVolume, SeparatedAirStandsStill) {
  const HeightMap map = world(400, 20, 0.5, [&](double x, double) { return dune(x + 40, 3, 40); });
  const SpectralVolume v(wind_relief(map, 0), 0, UpwindProfile::log_law(1e-4), LeeBubble{}, 10);
  EXPECT_EQ(v.velocity(-35, 0, 0.5).east, 0);
  EXPECT_GT(v.velocity(-35, 0, 6).east, 0);
}

TEST(SpectralVolume, RefusesWhatIsNotAllowed) {
  const WindRelief relief = wind_relief(world(4, 4, 1, [](double, double) { return 0; }), 0);
  EXPECT_THROW(SpectralVolume(relief, 0, UpwindProfile::uniform(), LeeBubble{}, 0), Error);
  EXPECT_THROW(SpectralVolume(relief, NAN, UpwindProfile::uniform(), LeeBubble{}, 1), Error);
  EXPECT_THROW(UpwindProfile::log_law(-1), Error);
}

}  // namespace
}  // namespace aeolian
