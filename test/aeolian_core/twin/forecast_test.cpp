#include "aeolian_core/twin/forecast.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Raises every known cell by one millimetre a second and writes down what it was asked.
class RisingBed : public BedModel {
 public:
  BedChange advance(HeightMap& map, const Forcing& forcing, double duration) override {
    durations.push_back(duration);
    directions.push_back(forcing.direction);
    saw_ground = map.has(layer::ground);
    for (float& z : map.layer(layer::elevation)) z += static_cast<float>(0.001 * duration);
    BedChange change;
    change.volume = {2 * duration, duration, duration, 0};
    return change;
  }
  std::vector<double> durations;
  std::vector<double> directions;
  bool saw_ground = false;
};

HeightMap start_map() {
  HeightMap map(GridGeometry(0, 0, 0.01, 3, 2));
  map.add(layer::elevation, HeightMap::Layer{0, 1, 2, 3, 4, HeightMap::unknown});
  return map;
}

TEST(Forecast, GoesOnFromOneHorizonToTheNext) {
  RisingBed model;
  Forcing forcing;
  forcing.direction = 0.7;
  const HeightMap start = start_map();
  const auto forecasts = make_forecasts(start, forcing, {10, 30, 60}, model);
  EXPECT_EQ(model.durations, (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(model.directions, (std::vector<double>{0.7, 0.7, 0.7}));
  ASSERT_EQ(forecasts.size(), 3U);
  const std::vector<double> leads{10, 30, 60};
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(forecasts[i].lead_time, leads[i]);
    EXPECT_DOUBLE_EQ(forecasts[i].volume.change, leads[i]);
    EXPECT_DOUBLE_EQ(forecasts[i].volume.moved, 2 * leads[i]);
    const HeightMap& map = forecasts[i].map;
    EXPECT_EQ(map.geometry(), start.geometry());
    for (std::size_t cell = 0; cell < 5; ++cell) {
      EXPECT_NEAR(map.layer(layer::elevation)[cell], static_cast<double>(cell) + 0.001 * leads[i], 1e-6);
      EXPECT_EQ(map.layer(layer::initial)[cell], static_cast<float>(cell));
      EXPECT_EQ(map.layer(layer::lead_time)[cell], static_cast<float>(leads[i]));
    }
    for (const auto& name : {layer::elevation, layer::initial, layer::lead_time})
      EXPECT_TRUE(std::isnan(map.layer(name)[5])) << name;
  }
}

TEST(Forecast, HardFloorReachesTheModel) {
  RisingBed model;
  HeightMap start = start_map();
  make_forecasts(start, {}, {1}, model);
  EXPECT_FALSE(model.saw_ground);
  start.add(layer::ground, -1);
  make_forecasts(start, {}, {1}, model);
  EXPECT_TRUE(model.saw_ground);
}

TEST(Forecast, RefusesBadHorizonsAndMaps) {
  RisingBed model;
  const HeightMap start = start_map();
  const std::vector<std::vector<double>> bad{{}, {0}, {-1}, {10, 10}, {10, 5}, {NAN}, {INFINITY}};
  for (const auto& horizons : bad) EXPECT_THROW(make_forecasts(start, {}, horizons, model), Error);
  HeightMap no_elevation(start.geometry());
  EXPECT_THROW(make_forecasts(no_elevation, {}, {1}, model), Error);
  HeightMap unknown(start.geometry());
  unknown.add(layer::elevation);
  EXPECT_THROW(make_forecasts(unknown, {}, {1}, model), Error);
  EXPECT_TRUE(model.durations.empty());
}

}  // namespace
}  // namespace aeolian
