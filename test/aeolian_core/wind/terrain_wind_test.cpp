#include "aeolian_core/wind/terrain_wind.hpp"

#include "../../error_of.hpp"
#include "relief_worlds.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/wind/direction.hpp"

namespace aeolian {
namespace {

HeightMap hill(double height) {
  return world(64, 64, 1.5, [&](double x, double y) { return gaussian(std::hypot(x, y), height, 15); });
}

WindInput reading(double speed, double direction, double height, std::optional<MapPoint> place = {}) {
  WindInput input;
  input.speed = speed;
  input.direction = direction;
  input.height = height;
  input.place = place;
  return input;
}

TEST(TerrainWind, TakesTheModelThatSuitsTheRelief) {
  TerrainWind model({});
  const WindInput wind = reading(8, 0, 2);
  const HeightMap flat = hill(0.05);
  EXPECT_EQ(model.solve(wind, &flat).model, "log law");
  EXPECT_TRUE(model.solve(wind, &flat).cells.names().empty());
  const HeightMap gentle = hill(3);
  EXPECT_EQ(model.solve(wind, &gentle).model, "spectral");
  const HeightMap steep = hill(25);
  EXPECT_EQ(model.solve(wind, &steep).model, "mass consistent");
  const HeightMap slip_face = world(200, 40, 0.5, [&](double x, double) { return dune(x, 3, 40); });
  EXPECT_EQ(model.solve(wind, &slip_face).model, "spectral");
  EXPECT_EQ(model.solve(wind, nullptr).model, "log law");
  TerrainWindSettings forced;
  forced.backend = WindBackend::mass_consistent;
  EXPECT_EQ(TerrainWind(forced).solve(wind, &gentle).model, "mass consistent");
}

TEST(TerrainWind, IsSolvedOnceASectorAndScaled) {
  TerrainWind model({});
  const HeightMap map = hill(2);
  const WindField slow = model.solve(reading(4, 0.05, 2), &map);
  const WindField fast = model.solve(reading(8, -0.05, 2), &map);
  EXPECT_EQ(model.solutions(), 1);
  for (std::size_t i = 0; i < map.geometry().size(); ++i)
    EXPECT_NEAR(fast.cells.layer("friction_velocity")[i], 2 * slow.cells.layer("friction_velocity")[i], 1e-6);
  EXPECT_NEAR(fast.cells.layer("direction")[0] - slow.cells.layer("direction")[0], -0.1, 1e-6);
  model.solve(reading(8, 0.3, 2), &map);
  EXPECT_EQ(model.solutions(), 2);
  for (int flip = 0; flip < 6; ++flip) model.solve(reading(8, flip % 2 ? M_PI : -M_PI, 2), &map);
  EXPECT_EQ(model.solutions(), 3);
  for (const double speed : {0.0, 60.0}) {
    const WindField field = model.solve(reading(speed, 3.1, 2), &map);
    for (const float u : field.cells.layer("friction_velocity")) ASSERT_TRUE(std::isfinite(u) && u >= 0);
  }
}

TEST(TerrainWind, IsSolvedAnewWhenReliefHasChangedEnough) {
  TerrainWind model({});
  HeightMap map = hill(2);
  WindInput wind = reading(8, 0, 2);
  model.solve(wind, &map);
  HeightMap::Layer& z = map.layer(layer::elevation);
  for (int y = 16; y < 48; ++y)  // ripples of a tile
    for (int x = 16; x < 48; ++x) z[map.geometry().index(x, y)] += 0.003F * static_cast<float>(x % 2);
  wind.time = 30;
  EXPECT_EQ(model.solve(wind, &map).age, 30);
  EXPECT_EQ(model.solutions(), 1);
  for (int y = 16; y < 48; ++y)
    for (int x = 16; x < 48; ++x)
      z[map.geometry().index(x, y)] += 0.5F * std::sin(0.2F * static_cast<float>(x));
  wind.time = 60;
  EXPECT_EQ(model.solve(wind, &map).age, 0);
  EXPECT_EQ(model.solutions(), 2);
  z[0] = HeightMap::unknown;
  const WindField field = model.solve(wind, &map);
  EXPECT_EQ(model.solutions(), 3);
  EXPECT_TRUE(std::isnan(field.cells.layer("friction_velocity")[0]));
}

TEST(TerrainWind, FindsTheSurroundingsOfAnAnemometerOnAHill) {
  TerrainWindSettings settings;
  settings.sector = 0;
  const HeightMap map = hill(2);
  TerrainWind model(settings);
  const double height = 0.5;
  const auto air = model.volume(map, 0.3, 2);
  for (const MapPoint place : {MapPoint{0, 0}, {-18, 3}, {7, -12}}) {
    const AirVelocity wind = air->velocity(place.x, place.y, height);
    const double speed = 0.4 * std::hypot(wind.east, wind.north);
    const WindField found =
        model.solve(reading(speed, std::atan2(wind.north, wind.east), height, place), &map);
    EXPECT_NEAR(found.friction_velocity, 0.4, 0.002);
    EXPECT_NEAR(found.direction, 0.3, 0.003);
  }
}

TEST(TerrainWind, TakesTheMeanOfSeveralAnemometers) {
  TerrainWind model({});
  const HeightMap map = hill(0);
  const WindField field = model.solve({reading(8, 0.1, 2), reading(8, -0.1, 2)}, &map);
  EXPECT_NEAR(field.direction, 0, 1e-12);
  EXPECT_NEAR(field.friction_velocity, friction_velocity(8, 2, 1e-5) * std::cos(0.1), 1e-12);
  EXPECT_THROW(model.solve(std::vector<WindInput>{}, &map), Error);
}

TEST(TerrainWind, RefusesAnAnemometerThatTellsNothing) {
  TerrainWind model({});
  const HeightMap map = world(200, 40, 0.5, [&](double x, double) { return dune(x, 3, 40); });
  const auto complaint = [&](const WindInput& wind) { return error_of([&] { model.solve(wind, &map); }); };
  EXPECT_NE(complaint(reading(8, 0, 1, MapPoint{8, 0})).find("separates behind a lee"), std::string::npos);
  EXPECT_NE(complaint(reading(8, 0, 1, MapPoint{800, 0})).find("beside the map"), std::string::npos);
  EXPECT_NE(complaint(reading(8, 0, 1e-6)).find("above the roughness length"), std::string::npos);
  EXPECT_NE(complaint(reading(8, 0, 1e-6, MapPoint{-30, 0})).find("above the roughness length"),
            std::string::npos);
  EXPECT_NE(complaint(reading(-1, 0, 1)).find("must be zero or positive"), std::string::npos);
  EXPECT_NE(complaint(reading(1, NAN, 1)).find("direction"), std::string::npos);
  WindInput thin = reading(1, 0, 1);
  thin.air_density = 0;
  EXPECT_NE(complaint(thin).find("air density"), std::string::npos);
  TerrainWindSettings settings;
  settings.sector = -1;
  EXPECT_THROW(TerrainWind{settings}, Error);
}

}  // namespace
}  // namespace aeolian
