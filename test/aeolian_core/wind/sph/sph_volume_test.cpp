#include "aeolian_core/wind/sph/sph_volume.hpp"

#include <cmath>

#include "../relief_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/wind/sph/thesis_volume.hpp"
#include "aeolian_core/wind/terrain_wind.hpp"

namespace aeolian {
namespace {

SphSettings coarse(int across, double flow_throughs) {
  SphSettings settings;
  settings.across = across;
  settings.flow_throughs = flow_throughs;
  return settings;
}

TEST(SphVolume, LevelGroundHasTheLogLaw) {  // F1
  const UpwindProfile upwind = UpwindProfile::log_law(1e-4);
  const SphVolume v(wind_relief(world(16, 16, 5, [](double, double) { return 7.0; }), 0), 0.7, upwind,
                    coarse(8, 0.5));
  for (const double z : {0.1, 1.0, 10.0}) {
    const AirVelocity wind = v.velocity(3, -2, z);
    EXPECT_NEAR(std::hypot(wind.east, wind.north), upwind.speed(z), 0.03 * upwind.speed(z));
    EXPECT_NEAR(std::atan2(wind.north, wind.east), 0.7, 0.01);
    EXPECT_NEAR(wind.up, 0, 0.02 * upwind.speed(z));
  }
  const FaceFlows& f = v.flows();
  const FaceFlows::Balance b = f.balance({0, f.nx(), 0, f.ny(), 0, f.nz()});
  EXPECT_GT(b.inflow, 0);
  EXPECT_LT(std::abs(b.net), 0.005 * b.inflow);  // trap 11
  EXPECT_TRUE(std::isnan(v.velocity(500, 0, 1).east));
  EXPECT_TRUE(std::isnan(v.velocity(0, 0, 1.1 * v.top()).east));
}

TEST(SphVolume, IsFasterOverARidgeAndRisesBeforeIt) {
  const WindRelief relief = wind_relief(ridge(160, 5, [](double x) { return agnesi(x, 15, 80); }), 0);
  const SphVolume v(relief, 0, UpwindProfile::uniform(), coarse(24, 1));
  const double rise = v.velocity(0, 0, 40).east - 1;
  EXPECT_NEAR(rise, 15.0 / 80 / (1.5 * 1.5), 0.03);
  EXPECT_GT(v.velocity(-60, 0, 30).up, 0.03);
  EXPECT_LT(v.velocity(60, 0, 30).up, -0.03);
  EXPECT_EQ(v.guards().slowed + v.guards().unsolved, 0U);
}

TEST(SphVolume, IsAModelOfTheWindThatMustBeAskedFor) {
  TerrainWindSettings settings;
  settings.backend = WindBackend::sph;
  settings.sph = coarse(8, 0.5);
  HeightMap map = world(20, 20, 5, [](double x, double y) { return gaussian(std::hypot(x, y), 8, 20); });
  map.layer(layer::elevation)[3] = HeightMap::unknown;
  TerrainWind model(settings);
  double ratio[2];
  for (int i = 0; i < 2; ++i) {
    WindInput input;
    input.speed = i == 0 ? 3 : 20;
    const WindField field = model.solve(input, &map);
    EXPECT_EQ(field.model, "SPH");
    const HeightMap::Layer& friction = field.cells.layer("friction_velocity");
    for (std::size_t c = 0; c < friction.size(); ++c) ASSERT_EQ(std::isfinite(friction[c]), c != 3);
    ratio[i] = static_cast<double>(friction[210]) / field.friction_velocity;
  }
  EXPECT_NEAR(ratio[0], ratio[1], 1e-5);  // C2
  EXPECT_GT(ratio[0], 1.05);
  EXPECT_EQ(model.solutions(), 1);
}

TEST(SphVolume, RefusesWhatIsNotAllowed) {
  const WindRelief relief = wind_relief(world(16, 16, 1, [](double, double) { return 0; }), 0);
  EXPECT_THROW(SphVolume(relief, NAN, UpwindProfile::uniform(), {}), Error);
  EXPECT_THROW(SphVolume(relief, 0, UpwindProfile::uniform(), coarse(4, 1)), Error);
  EXPECT_THROW(SphVolume(relief, 0, UpwindProfile::uniform(), coarse(16, 0)), Error);
}

TEST(ThesisAir, HasTheDefectsThatTheSpecTells) {  // trap 6; f+(900) of section 2.7
  const WindRelief level = wind_relief(world(8, 8, 200, [](double, double) { return 0.0; }), 0);
  sph::BoxPlace place;
  place.spacing = 125;
  place.nx = place.ny = 12;
  place.x = place.y = -750;
  for (const bool near : {false, true}) {
    sph::ThesisSettings settings;
    settings.side = 8;
    settings.near_kernels = near;
    sph::ThesisAir air(sph::AirGround(level, place), settings);
    EXPECT_EQ(air.size(), 12U * 12 * 10);  // (s + 2 r_d)^2 (s + r_d)
    air.step();
    EXPECT_NEAR(air.mean_density(), near ? 0.525 + 6.56 : 0.525, 0.05 * (near ? 7.1 : 0.525));
  }
  EXPECT_NEAR(sph::ThesisAir::lift_divisor(900, 3, true) / (2.0472 / 3 + 0.3032), 26.7, 0.1);
}

ThesisVolumeSettings thesis_of(double speed) {
  ThesisVolumeSettings settings;
  settings.air.side = 8;
  settings.air.wind = speed;
  settings.lift_adjusted = false;
  return settings;
}

TEST(ThesisVolume, BlowsThroughAndItsLiftDependsOnTheSpeed) {  // traps 2 and 4
  const WindRelief relief = wind_relief(
      world(20, 20, 50, [](double x, double y) { return gaussian(std::hypot(x, y), 80, 200); }), 0);
  double lift[2];
  for (int n = 0; n < 2; ++n) {
    const ThesisVolume v(relief, 0.5 * M_PI, UpwindProfile::uniform(), thesis_of(n == 0 ? 3 : 20));
    double north = 0;
    double east = 0;
    int count = 0;
    lift[n] = 0;
    for (double y = -400; y < 500; y += 100)
      for (double z = 60; z < 400; z += 60) {
        const AirVelocity u = v.velocity(50, y, z);
        if (!std::isfinite(u.north)) continue;
        ++count;
        north += u.north;
        east += u.east;
        lift[n] += u.up;
      }
    ASSERT_GT(count, 10);  // Its air falls: most cells above are empty.
    // ApplyWind lets none be slower than the wind, but the limiter then shrinks what falls.
    EXPECT_GT(north / count, 0.5);
    EXPECT_LT(north / count, 2);
    EXPECT_NEAR(east / count, 0, 0.3);
    lift[n] /= count;
    EXPECT_TRUE(std::isnan(v.velocity(50, 0, 2 * v.top()).up));
  }
  // In units of the wind a neutral air's would be the same.
  EXPECT_GT(std::abs(lift[0] - lift[1]), 0.05 * std::abs(lift[1]));
}

TEST(ThesisVolume, IsAModelOfTheWindThatMustBeAskedFor) {
  TerrainWindSettings settings;
  settings.backend = backend_of("thesis_compatible");
  ASSERT_EQ(settings.backend, WindBackend::thesis_compatible);
  settings.thesis = thesis_of(10);
  TerrainWind model(settings);
  const HeightMap map =
      world(20, 20, 50, [](double x, double y) { return gaussian(std::hypot(x, y), 40, 200); });
  WindInput input;
  input.speed = 10;
  EXPECT_EQ(model.solve(input, &map).model, "thesis compatible");
  settings.thesis.air.wind = 0;
  EXPECT_THROW(TerrainWind(settings).solve(input, &map), Error);
}

}  // namespace
}  // namespace aeolian
