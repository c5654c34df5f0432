#include "aeolian_core/bedforms/lattice/haff_model.hpp"

#include <cmath>

#include "../../../error_of.hpp"
#include "grain_model_fixture.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

using Fixture = GrainModelFixture;

HeightMap seen_from(const HeightMap& map, int quarter) {
  const GridGeometry& g = map.geometry();
  const int n = g.nx();  // of a square
  HeightMap turned(g);
  HeightMap::Layer& h = turned.add(layer::elevation, 0.0F);
  for (int row = 0; row < n; ++row)
    for (int along = 0; along < n; ++along) {
      const int at = quarter < 2 ? along : n - 1 - along;
      h[g.index(along, row)] =
          map.layer(layer::elevation)[quarter % 2 == 0 ? g.index(at, row) : g.index(row, at)];
    }
  return turned;
}

TEST(HaffModelTest, keeps_its_sand_and_moves_as_much_as_the_forcing_says) {
  HeightMap map = Fixture::rippled();
  const double before = Fixture::volume(map);
  HaffModel model({}, 1);
  for (int i = 0; i < 3; ++i) {
    const BedChange change = model.advance(map, Fixture::wind(), 20);
    EXPECT_LT(std::abs(change.volume.error()), 1e-12);
    EXPECT_NEAR(change.volume.moved / (20e-4 * 0.096 * 0.064), 1, 0.01);
    EXPECT_GT(change.active.count(), 0);
  }
  EXPECT_NEAR(Fixture::volume(map), before, Fixture::rounding(map));
}

TEST(HaffModelTest, short_steps_move_as_much_as_long_ones) {
  HeightMap map = Fixture::rippled();
  HaffModel model({}, 1);
  double moved = 0;
  for (int i = 0; i < 1000; ++i) moved += model.advance(map, Fixture::wind(), 0.01).volume.moved;
  EXPECT_NEAR(moved / (10e-4 * 0.096 * 0.064), 1, 0.05);
}

TEST(HaffModelTest, every_axis_is_alike) {
  const HeightMap map = Fixture::rippled(40, 40);
  for (int quarter = 0; quarter < 4; ++quarter) {
    HeightMap turned = map, straight = seen_from(map, quarter);
    HaffModel model({}, 3), other({}, 3);
    model.advance(turned, Fixture::wind(quarter * M_PI / 2 - 2 * M_PI), 10);
    other.advance(straight, Fixture::wind(), 10);
    const HeightMap result = seen_from(turned, quarter);
    for (std::size_t i = 0; i < map.geometry().size(); ++i)
      ASSERT_NEAR(result.layer(layer::elevation)[i], straight.layer(layer::elevation)[i], 2e-6);
  }
}

TEST(HaffModelTest, goes_on_with_its_grains_unless_the_map_or_the_wind_is_changed) {
  HeightMap map = Fixture::rippled();
  HaffModel model({}, 1);
  model.advance(map, Fixture::wind(), 5);
  // Nearly nothing falls: a new start would let slide what rounding to grains made too steep, if anything.
  Forcing breath = Fixture::wind();
  breath.ejection_rate *= 1e-9;
  const HeightMap before = map;
  model.advance(map, breath, 1);
  EXPECT_EQ(map.layer(layer::elevation), before.layer(layer::elevation));
  const double volume = Fixture::volume(map);
  model.advance(map, Fixture::wind(M_PI / 2), 5);
  map.layer(layer::elevation)[100] += 1e-3F;
  model.advance(map, Fixture::wind(M_PI / 2), 5);
  EXPECT_NEAR(Fixture::volume(map), volume + 1e-3 * 4e-6, Fixture::rounding(map));
}

TEST(HaffModelTest, calm_and_hops_once_around_change_nothing) {
  HeightMap map = Fixture::rippled();
  const HeightMap before = map;
  HaffModel model({}, 1);
  Forcing calm = Fixture::wind();
  calm.ejection_rate = 0;
  EXPECT_EQ(model.advance(map, calm, 1000).active.count(), 0);
  EXPECT_EQ(model.advance(map, Fixture::wind(), 0).active.count(), 0);
  Forcing around = Fixture::wind();
  around.reptation_length = 0.096;
  EXPECT_EQ(model.advance(map, around, 10).active.count(), 0);
  EXPECT_EQ(map.layer(layer::elevation), before.layer(layer::elevation));
}

TEST(HaffModelTest, stands_extremes) {
  for (const double angle : {0.02, 1.4})
    for (const double reptation : {0.001, 5.0013}) {
      HeightMap map = Fixture::rippled(15, 9);
      map.layer(layer::elevation)[20] += 0.1F;
      const double before = Fixture::volume(map);
      Forcing forcing = Fixture::wind(M_PI);
      forcing.impact_angle = angle;
      forcing.reptation_length = reptation;
      HaffModelParameters limited;
      limited.steepest_stoss = 0.17;
      HaffModel model(limited, 2);
      model.advance(map, forcing, 2000);
      EXPECT_EQ(count_known(map.layer(layer::elevation)), map.geometry().size());
      EXPECT_NEAR(Fixture::volume(map), before, Fixture::rounding(map));
    }
}

TEST(HaffModelTest, refuses_what_it_cannot_carry_forward) {
  HaffModel model({}, 1);
  HeightMap map = Fixture::rippled();
  const auto error = [&](HeightMap& on, const Forcing& forcing) {
    return error_of([&] { model.advance(on, forcing, 1); });
  };
  EXPECT_EQ(error(map, Fixture::wind(17 * M_PI / 180)),
            "Haff model: the wind blows to 17.000000 degrees, must be along an axis of the grid: 0, 90, 180 "
            "or 270");
  Forcing hopless = Fixture::wind();
  hopless.reptation_length = 0.0009;
  EXPECT_EQ(error(map, hopless),
            "Haff model: reptation length is 0.000900 m, must be at least half a bin, 0.001000 m");
  HeightMap tall = map;
  tall.layer(layer::elevation)[5] = 100;
  EXPECT_EQ(error(tall, Fixture::wind()).find("Haff model: the relief along a row is"), 0U);
  tall.layer(layer::elevation)[5] = HeightMap::unknown;
  EXPECT_EQ(error(tall, Fixture::wind()),
            "Haff model: 1 of 1536 cells of the layer elevation are unknown, all must be known");
  map.add(layer::ground, 0.0F);
  EXPECT_EQ(error(map, Fixture::wind()), "Haff model: the map has a layer ground, must be sand all through");
  EXPECT_EQ(error_of([] {
              HaffModel({0, {}}, 1);
            }),
            "Haff model: bin length is 0.000000 d, must be positive");
  EXPECT_EQ(error_of([] {
              HaffModel({4, 2.0}, 1);
            }),
            "Haff model: steepest stoss is 2.000000 rad, must be between 0 and pi / 2");
}

}  // namespace
}  // namespace aeolian
