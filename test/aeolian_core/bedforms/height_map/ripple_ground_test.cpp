#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "ripple_bed.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/bedforms/height_map/ripple_model.hpp"

namespace aeolian {
namespace {

/// A map of sand with a rise of rock in it, a flat of rock, and unknown cells.
HeightMap rocky_map(double sand_depth) {
  const GridGeometry g(0, 0, 0.002, 200, 120);
  HeightMap map(g);
  const std::vector<double> rough = noise(g, 3e-4);
  HeightMap::Layer& h = map.add(layer::elevation);
  HeightMap::Layer ground(g.size(), HeightMap::unknown);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      h[i] = static_cast<float>(0.01 + rough[i]);
      const double rise = 0.02 * std::exp(-0.005 * ((x - 60.0) * (x - 60) + (y - 60.0) * (y - 60)));
      if (x < 100) ground[i] = static_cast<float>(0.01 - sand_depth + rise);
      if (x >= 100 && x < 150) ground[i] = 0.01F;
      if (std::isfinite(ground[i])) h[i] = std::max(h[i], ground[i]);
      if (x >= 100 && x < 150) h[i] = 0.01F;
      if (x >= 160 && x < 175 && y > 30 && y < 80) h[i] = HeightMap::unknown;
    }
  map.add(layer::ground, ground);
  return map;
}

TEST(RippleGroundTest, hard_ground_is_never_eroded_and_sand_is_conserved_on_it) {
  for (const double direction : {0.0, 0.4, M_PI / 4, 2.0, -2.5}) {
    HeightMap map = rocky_map(0.0005);
    const GridGeometry& g = map.geometry();
    const HeightMap::Layer before = map.layer(layer::elevation);
    const HeightMap::Layer ground = map.layer(layer::ground);
    const BedChange change = RippleModel(RippleParameters{}).advance(map, wind(direction), 120);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12) << direction;
    double moved = 0;
    double total = 0;
    const HeightMap::Layer& after = map.layer(layer::elevation);
    for (std::size_t i = 0; i < before.size(); ++i) {
      ASSERT_EQ(std::isfinite(before[i]), std::isfinite(after[i]));
      if (!std::isfinite(before[i])) continue;
      if (std::isfinite(ground[i])) {
        ASSERT_GE(after[i], ground[i] - 1e-8F) << direction << ' ' << i % 200 << ' ' << i / 200;
      }
      moved += std::abs(static_cast<double>(after[i]) - static_cast<double>(before[i]));
      total += static_cast<double>(after[i]) - static_cast<double>(before[i]);
    }
    EXPECT_GT(moved, 0);
    // What the known cells gained is what the whole bed gained: nothing went into the unknown ones.
    EXPECT_NEAR(total * g.cell() * g.cell(), change.volume.change, 1e-7 * g.cell() * g.cell()) << direction;
  }
}

TEST(RippleGroundTest, the_part_that_is_worked_on_is_worked_on_as_in_the_whole) {
  // An unknown cell far from the sand has the whole grid worked on.
  const GridGeometry g(0, 0, 0.002, 500, 400);
  HeightMap map(g);
  map.add(layer::elevation);
  map.add(layer::ground);
  const std::vector<double> rough = noise(g, 3e-4);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      map.layer(layer::ground)[i] = static_cast<float>(0.002 * std::sin(0.05 * x + 0.03 * y));
      const bool sand = x >= 220 && x < 280 && y >= 170 && y < 230;
      map.layer(layer::elevation)[i] =
          map.layer(layer::ground)[i] + (sand ? static_cast<float>(0.004 + std::abs(rough[i])) : 0.0F);
    }
  for (const double direction : {0.4, 2.0, M_PI}) {
    HeightMap part = map;
    const BedChange change = RippleModel(RippleParameters{}).advance(part, wind(direction), 60);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12);
    HeightMap whole = map;
    const std::size_t hole = g.index(direction == 0.4 ? 20 : 480, 20);
    whole.layer(layer::elevation)[hole] = HeightMap::unknown;
    RippleModel(RippleParameters{}).advance(whole, wind(direction), 60);
    for (std::size_t i = 0; i < g.size(); ++i) {
      if (i == hole) continue;
      ASSERT_NEAR(part.layer(layer::elevation)[i], whole.layer(layer::elevation)[i], 1e-5F)
          << direction << ' ' << i % 500 << ' ' << i / 500;
    }
  }
}

TEST(RippleGroundTest, sheltered_sand_is_left_as_it_is) {
  // A lee of 28 degrees that shades more than grains hop, and noise that nothing can reach.
  const GridGeometry g(0, 0, 0.002, 640, 70);
  const std::vector<double> rough = noise(g, 2e-5);
  HeightMap map(g);
  map.add(layer::ground);  // unknown: none
  HeightMap::Layer& h = map.add(layer::elevation);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x)
      h[g.index(x, y)] =
          static_cast<float>(0.106 * (1 - std::clamp((x - 200) / 100.0, 0.0, 1.0)) + rough[g.index(x, y)]);
  const HeightMap::Layer before = h;
  Forcing forcing = wind();
  forcing.reptation_length = 0.004;
  const BedChange change = RippleModel(parameters(Border::open, 0.4, 1)).advance(map, forcing, 20);
  EXPECT_NEAR(change.volume.error(), 0, 1e-12);
  for (int y = 0; y < g.ny(); ++y)
    for (const int x : {250, 300, 350})  // to what rounding to floats hands on
      EXPECT_NEAR(map.layer(layer::elevation)[g.index(x, y)], before[g.index(x, y)], 1e-8F);
}

TEST(RippleGroundTest, bare_ground_costs_nothing_and_changes_nothing) {
  // Sand in one corner of a hard plain with some relief: the run must not depend on what is skipped.
  const GridGeometry g(0, 0, 0.002, 256, 192);
  HeightMap map(g);
  HeightMap::Layer& h = map.add(layer::elevation, 0.0F);
  HeightMap::Layer ground(g.size());
  const std::vector<double> rough = noise(g, 3e-4);
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const std::size_t i = g.index(x, y);
      ground[i] = static_cast<float>(0.003 * std::sin(0.1 * x) * std::cos(0.07 * y));
      const bool sand = x >= 100 && x < 140 && y >= 70 && y < 110;
      h[i] = ground[i] + (sand ? static_cast<float>(0.004 + std::abs(rough[i])) : 0.0F);
    }
  map.add(layer::ground, ground);
  for (const double direction : {0.0, 0.5, -1.9}) {
    HeightMap forecast = map;
    const BedChange change = RippleModel(RippleParameters{}).advance(forecast, wind(direction), 60);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12);
    EXPECT_GT(change.active.count(), 3);
    EXPECT_LT(change.active.count(), 30);  // of 48
    // Far upwind nothing happens, bit for bit.
    const int x = direction < -1 ? 120 : 20;
    const int y = direction < -1 ? 180 : 20;
    EXPECT_EQ(forecast.layer(layer::elevation)[g.index(x, y)], h[g.index(x, y)]);
  }
}

TEST(RippleGroundTest, pits_of_unknown_floor_among_rock_are_not_dug_ever_deeper_at_the_upwind_border) {
  const GridGeometry g(0, 0, 0.005, 40, 40);
  for (const double direction : {0.0, 0.4, 1.2}) {
    HeightMap map(g);
    map.add(layer::elevation, 0.0F);
    HeightMap::Layer& ground = map.add(layer::ground, 0.0F);
    RandomStream random(3, 0);
    for (float& floor : ground)
      if (random.uniform() < 0.1) floor = HeightMap::unknown;
    RippleParameters p = parameters(Border::open, 0.4, 1);
    p.lateral_spread = 1;
    Forcing forcing = wind(direction);
    forcing.reptation_length = 0.03;
    RippleModel(p).advance(map, forcing, 500);
    for (std::size_t i = 0; i < g.size(); ++i)
      ASSERT_GT(map.layer(layer::elevation)[i], -0.02F) << direction << ": " << i % 40 << ' ' << i / 40;
  }
}

TEST(RippleGroundTest, rock_is_not_dug_into_where_lines_go_round_in_shadows_longer_than_a_periodic_map) {
  const GridGeometry g(0, 0, 0.0005, 40, 40);
  for (const double direction : {0.1, 2.5}) {
    HeightMap map(g);
    HeightMap::Layer& h = map.add(layer::elevation);
    HeightMap::Layer ground(g.size());
    const std::vector<double> rough = noise(g, 1e-3);
    const std::vector<double> strewn = noise(g, 1e-3, 2);
    for (std::size_t i = 0; i < g.size(); ++i) {
      ground[i] = static_cast<float>(rough[i] + (i % 137 == 11 && i < 600 ? 0.03 : 0));
      h[i] = ground[i] + static_cast<float>(std::max(0.0, strewn[i]));
    }
    map.add(layer::ground, ground);
    Forcing forcing = wind(direction);
    forcing.reptation_length = 0.003;
    const BedChange change = RippleModel(parameters(Border::periodic, 0.4, 1)).advance(map, forcing, 20);
    EXPECT_NEAR(change.volume.error(), 0, 1e-12) << direction;
    for (std::size_t i = 0; i < g.size(); ++i)
      ASSERT_GE(map.layer(layer::elevation)[i], ground[i] - 1e-8F) << direction << ": cell " << i;
  }
}

}  // namespace
}  // namespace aeolian
