#include "aeolian_core/wind/wind_probe.hpp"

#include "../../error_of.hpp"
#include "relief_worlds.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

TEST(WindProbe, OverLevelGroundItIsTheLogLaw) {
  WindField field;
  field.friction_velocity = 0.4;
  field.direction = M_PI / 2;
  const WindProbe probe(field, nullptr, 1e-4, 1);
  const ProbeReading r = probe.at({3, 4}, 10);
  EXPECT_NEAR(r.mean.north, std::log(1e5), 1e-9);
  EXPECT_NEAR(r.mean.east, 0, 1e-12);
  EXPECT_EQ(r.mean.up, 0);
  // About 1/ln(z/z0).
  EXPECT_NEAR(r.intensity, 2.18 * 0.4 / std::log(1e5), 1e-3);
  EXPECT_FALSE(r.separated);
  EXPECT_NE(error_of([&] { probe.at({0, 0}, 1e-5); }).find("above the roughness length"), std::string::npos);
}

TEST(WindProbe, OverADuneItRisesOnTheStossAndIsAtRestInTheLee) {
  TerrainWind model({});
  const HeightMap map = world(200, 40, 0.5, [&](double x, double) { return dune(x, 3, 40); });
  WindInput wind;
  wind.speed = 8;
  wind.height = 2;
  const WindField field = model.solve(wind, &map);
  const WindProbe probe(field, model.volume(map, 0, 20), 1e-5, 0.3);
  EXPECT_GT(probe.at({-20, 0}, 1).mean.up, 0.1);
  const ProbeReading lee = probe.at({4, 0}, 0.5);
  EXPECT_TRUE(lee.separated);
  EXPECT_EQ(lee.mean.east, 0);
  EXPECT_GE(lee.friction_velocity, 0.99 * field.friction_velocity);
  EXPECT_FALSE(probe.at({4, 0}, 15).separated);
  EXPECT_EQ(probe.gusts({-20, 0}, 1, 0.1, 64, 3).along.size(), 64u);
  EXPECT_NE(error_of([&] {
              probe.gusts({4, 0}, 0.5, 0.1, 64, 3);
            }).find("mean wind is not known"),
            std::string::npos);
  EXPECT_TRUE(std::isnan(probe.at({1000, 0}, 1).mean.east));
}

}  // namespace
}  // namespace aeolian
