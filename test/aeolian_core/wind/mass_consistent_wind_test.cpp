#include "aeolian_core/wind/mass_consistent_wind.hpp"

#include <algorithm>

#include "relief_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

MassConsistentVolume::Settings boxes(std::size_t most) { return {most, 1}; }

TEST(MassConsistentWind, IsPotentialFlowOverAHalfCylinder) {
  const double a = 250;
  for (const double cell : {12.5, 6.25}) {
    const HeightMap map = ridge(static_cast<int>(8 * a / cell), cell,
                                [&](double x) { return std::abs(x) < a ? std::sqrt(a * a - x * x) : 0; });
    const WindRelief relief = wind_relief(map, 0);
    const MassConsistentVolume v(relief, 0, UpwindProfile::uniform(), boxes(400000));
    double worst = 0;
    for (double z = 6; z < 400; z += 9)
      for (double x = -490; x < 500; x += 13) {
        const double r2 = x * x + z * z;
        if (std::sqrt(r2) < a + 1.5 * cell) continue;
        const AirVelocity wind = v.velocity(x, 0, z - v.grid().ground(x, 0) - relief.mean);
        const double east = 1 - a * a * (x * x - z * z) / (r2 * r2);
        worst = std::max(worst, std::hypot(wind.east - east, wind.up + 2 * a * a * x * z / (r2 * r2)));
      }
    EXPECT_LT(worst, 0.1);
    EXPECT_NEAR(v.velocity(0, 0, 0.1).east, 2, 0.2);
  }
}

TEST(MassConsistentWind, HemisphereAndEveryDirection) {
  const HeightMap map =
      world(48, 48, 12.5, [](double x, double y) { return std::sqrt(std::max(0.0, 1e4 - x * x - y * y)); });
  const WindRelief relief = wind_relief(map, 0);
  for (const double angle : {0.0, M_PI / 4, -2.0}) {
    const MassConsistentVolume v(relief, angle, UpwindProfile::uniform(), boxes(120000));
    const AirVelocity crest = v.velocity(0, 0, 1);
    EXPECT_NEAR(crest.east * std::cos(angle) + crest.north * std::sin(angle), 1.5, 0.15);
    EXPECT_NEAR(crest.up, 0, 0.03);
  }
}

TEST(MassConsistentWind, NoBoxGainsOrLosesAir) {
  const HeightMap map = world(
      40, 30, 10, [](double x, double y) { return gaussian(std::hypot(x, y), 60, 40) + (x > 120 ? 30 : 0); });
  for (int eighth = 0; eighth < 8; eighth += 3) {
    const MassConsistentVolume v(wind_relief(map, 0), eighth * M_PI / 4, UpwindProfile::log_law(0.01),
                                 boxes(60000));
    const FaceFlows& f = v.flows();
    for (const BoxRange& box : {BoxRange{0, f.nx(), 0, f.ny(), 0, f.nz()},
                                {5, f.nx() / 2, 3, f.ny() - 2, 0, f.nz() / 2},
                                {f.nx() / 2, f.nx() / 2 + 1, f.ny() / 2, f.ny() / 2 + 1, 20, 35}}) {
      const FaceFlows::Balance b = f.balance(box);
      EXPECT_GT(b.inflow, 0);
      EXPECT_LT(std::abs(b.net), 1e-6 * b.inflow);
    }
  }
}

TEST(MassConsistentWind, FlatGroundHasTheLogLaw) {
  const HeightMap map = world(20, 20, 5, [](double, double) { return 100.0; });
  const MassConsistentVolume v(wind_relief(map, 0), 1, UpwindProfile::log_law(0.01), boxes(20000));
  for (const double z : {0.5, 2.0, 10.0}) {
    const AirVelocity wind = v.velocity(3, -7, z);
    EXPECT_NEAR(std::hypot(wind.east, wind.north), UpwindProfile::log_law(0.01).speed(z),
                0.02 * UpwindProfile::log_law(0.01).speed(z));
    EXPECT_NEAR(std::atan2(wind.north, wind.east), 1, 1e-6);
    EXPECT_NEAR(wind.up, 0, 1e-6);
  }
}

TEST(MassConsistentWind, StaysFiniteOnWhatNobodyWouldChoose) {
  ReliefSettings settings;
  settings.roughness = 1e-3;
  const std::function<double(double, double)> worlds[] = {
      [](double x, double) { return x > 0 ? 50.0 : 0.0; },
      [](double x, double y) { return std::abs(x) < 0.6 && std::abs(y) < 0.6 ? 1e3 : 0; },
      [](double, double) { return 5.0; }};
  for (const auto& height : worlds)
    for (const auto& [nx, ny] : {std::pair{24, 15}, {24, 1}, {1, 24}, {1, 1}})
      for (const double angle : {0.0, 2.0}) {
        HeightMap map = world(nx, ny, 1, height);
        if (nx > 10) map.layer(layer::elevation)[3] = HeightMap::unknown;
        const TerrainResponse r = mass_consistent_response(map, angle, settings, boxes(20000));
        for (std::size_t i = 0; i < r.friction.size(); ++i) {
          if (!std::isfinite(map.layer(layer::elevation)[i])) continue;
          ASSERT_TRUE(std::isfinite(r.friction[i]) && r.friction[i] >= 0 && r.friction[i] < 100);
          ASSERT_TRUE(std::isfinite(r.deflection[i]));
        }
      }
}

TEST(MassConsistentWind, RefusesWhatIsNotAllowed) {
  const WindRelief relief = wind_relief(world(4, 4, 1, [](double, double) { return 0; }), 0);
  const UpwindProfile uniform = UpwindProfile::uniform();
  EXPECT_THROW(MassConsistentVolume(relief, NAN, uniform, {}), Error);
  EXPECT_THROW(MassConsistentVolume(relief, 0, uniform, {10, 1}), Error);
  EXPECT_THROW(MassConsistentVolume(relief, 0, uniform, {10000, 0}), Error);
}

}  // namespace
}  // namespace aeolian
