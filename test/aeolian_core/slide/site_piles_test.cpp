#include "aeolian_core/slide/piles/site_piles.hpp"

#include <cmath>
#include <string>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// The laboratory's scene, coarse and of soft snow: quick. Heights are those of the map.
SlideScene scene_at_site() {
  SlideScene scene;
  scene.cell = 0.01;
  scene.threads = 1;
  scene.panel_friction = 0.4;
  scene.snow.youngs_modulus = 2.5e5;
  scene.panel_height = 1.33;
  return scene;
}

/// 4 m x 4 m about the panel of `site`, level at 1 m.
HeightMap level_ground(float height = 1) {
  HeightMap map(GridGeometry(-2, -2, 0.01, 400, 400));
  map.add(layer::elevation, height);
  map.add(layer::variance, 1e-6F);
  return map;
}

double volume(const HeightMap& patch) {
  double sum = 0;
  const double cell = patch.geometry().cell();
  for (std::size_t k = 0; k < patch.geometry().size(); ++k)
    if (std::isfinite(patch.layer(layer::elevation)[k]))
      sum +=
          static_cast<double>(patch.layer(layer::elevation)[k] - patch.layer(layer::ground)[k]) * cell * cell;
  return sum;
}

/// Puts a patch into a map of the same cells.
void put(const HeightMap& patch, HeightMap& map) {
  for (std::size_t k = 0; k < patch.geometry().size(); ++k) {
    const CellIndex at = patch.geometry().cell_at(k);
    const auto there = map.geometry().find(patch.geometry().x(at.x), patch.geometry().y(at.y));
    if (!std::isfinite(patch.layer(layer::elevation)[k])) continue;
    for (const std::string& name : {layer::elevation, layer::variance})
      map.layer(name)[map.geometry().index(*there)] = patch.layer(name)[k];
  }
}

TEST(SlideSite, IsWhereItSlides) {
  const SlideSite north{10, 20, M_PI / 2};
  EXPECT_NEAR((north.to_map({2, 0}) - Point<2>(10, 22)).norm(), 0, 1e-12);
  EXPECT_NEAR((north.to_map({0, 1}) - Point<2>(9, 20)).norm(), 0, 1e-12);
  EXPECT_NEAR((north.to_slide(north.to_map({0.3, -0.7})) - Point<2>(0.3, -0.7)).norm(), 0, 1e-12);
}

TEST(SlideSite, TakesTheGroundOutOfTheMap) {
  HeightMap map = level_ground();
  const GridGeometry& grid = map.geometry();
  for (std::size_t k = 0; k < grid.size(); ++k)  // rises to the north
    map.layer(layer::elevation)[k] += 0.1F * static_cast<float>(grid.y(grid.cell_at(k).y));
  const SlideSite north{0.3, -0.2, M_PI / 2};
  for (const int dimensions : {2, 3}) {
    const SiteGround ground = ground_of_site(map, scene_at_site(), north, dimensions);
    const GridGeometry& local = ground.map.geometry();
    EXPECT_EQ(local.ny() > 1, dimensions == 3);
    EXPECT_EQ(ground.guessed, 0);
    // A block without friction of air lands within.
    EXPECT_GT(local.x(local.nx() - 1), 0.3);
    EXPECT_LT(local.x(local.nx() - 1), 1);
    for (std::size_t k = 0; k < local.size(); ++k)
      EXPECT_NEAR(static_cast<double>(ground.map.layer(layer::elevation)[k]),
                  1 + 0.1 * (-0.2 + local.x(local.cell_at(k).x)), 1e-5);
  }
}

TEST(SlideSite, WhatIsPanelIsNotGround) {
  const SlideScene scene = scene_at_site();
  HeightMap map = level_ground();
  const GridGeometry& grid = map.geometry();
  for (std::size_t k = 0; k < grid.size(); ++k) {  // as a scanner from above sees the panel
    const double x = grid.x(grid.cell_at(k).x), y = grid.y(grid.cell_at(k).y);
    if (std::abs(x) < 0.5 * scene.panel_length * std::cos(scene.tilt) &&
        std::abs(y) < 0.5 * scene.panel_width)
      map.layer(layer::elevation)[k] =
          static_cast<float>(scene.panel_height - x * std::tan(scene.tilt) + 0.001);
  }
  const SiteGround ground = ground_of_site(map, scene, {}, 2);
  EXPECT_GT(ground.guessed, 0.1);
  for (const float z : ground.map.layer(layer::elevation)) EXPECT_NEAR(z, 1, 1e-3);
}

TEST(SlideSite, RefusesGroundThatIsNotKnown) {
  HeightMap map = level_ground();
  map.layer(layer::elevation)[map.geometry().index(220, 200)] = HeightMap::unknown;
  EXPECT_GT(ground_of_site(map, scene_at_site(), {}, 2).guessed, 0) << "a hole is filled";
  for (int x = 230; x < 400; ++x)
    for (int y = 0; y < 400; ++y)
      map.layer(layer::elevation)[map.geometry().index(x, y)] = HeightMap::unknown;
  const std::string told = error_of([&] { ground_of_site(map, scene_at_site(), {}, 2); });
  EXPECT_EQ(told.find("ground: "), 0U) << told;
  EXPECT_NE(told.find("is not known, must be at most 10 %"), std::string::npos) << told;
  EXPECT_NE(error_of([&] {
              ground_of_site(map, scene_at_site(), {50, 0, 0}, 2);
            }).find("100 % of the"),
            std::string::npos);
  map.add(layer::elevation);
  EXPECT_EQ(error_of([&] { ground_of_site(map, scene_at_site(), {}, 2); }),
            "ground: no cell of the map is known");
}

TEST(SitePiles, APatchHoldsTheSnow) {
  const SlideScene scene = scene_at_site();
  const HeightMap map = level_ground();
  for (const double direction : {0., 0.7}) {
    const auto piles = make_site_piles(scene, {0.1, 0.2, direction}, 2, 0.2);
    const auto event = piles->release(map, 0.02);
    EXPECT_EQ(event->news, PileNews::none);
    // Snow in a pile is denser than fresh, but hovers by up to a cell, and edges are cut.
    const double fresh = 0.245 * 0.02 * 0.142;
    EXPECT_NEAR(volume(event->patch), fresh, 0.6 * fresh);
    const HeightMap::Layer& top = event->patch.layer(layer::elevation);
    float highest = 0;
    for (std::size_t k = 0; k < top.size(); ++k) {
      if (!std::isfinite(top[k])) continue;
      const double depth = static_cast<double>(top[k] - event->patch.layer(layer::ground)[k]);
      EXPECT_NEAR(event->patch.layer(layer::ground)[k], 1, 1e-6);
      const double grid = (scene.cell * scene.cell + scene.cell * scene.cell) / 12;
      EXPECT_NEAR(event->patch.layer(layer::variance)[k], 1e-6 + grid + 0.04 * depth * depth, 1e-6);
      highest = std::max(highest, top[k]);
    }
    EXPECT_NEAR(highest - 1, event->size.height, 0.012);
    const GridGeometry& g = event->patch.geometry();
    const Point<2> middle(g.origin_x() + 0.5 * g.length_x(), g.origin_y() + 0.5 * g.length_y());
    const Point<2> in_slide = SlideSite{0.1, 0.2, direction}.to_slide(middle);
    EXPECT_NEAR(in_slide.y(), 0, 0.03);
    EXPECT_GT(in_slide.x(), 0.05);
  }
}

TEST(SitePiles, GoOnWhetherTheMapShowsThePileOrNot) {
  const HeightMap bare = level_ground();
  const auto second = [&](bool put_back) {
    const auto piles = make_site_piles(scene_at_site(), {}, 2, 0.2);
    HeightMap map = bare;
    const auto first = piles->release(map, 0.02);
    if (put_back) put(first->patch, map);
    auto event = piles->release(map, 0.02);
    EXPECT_EQ(event->news, put_back ? PileNews::seen : PileNews::unseen);
    EXPECT_EQ(event->number, 2);
    EXPECT_GT(event->size.height, first->size.height);
    const float top = 0.04F * 0.25F * 0.25F;  // no pile is deeper: variances do not add up over events
    for (const float v : event->patch.layer(layer::variance))
      if (std::isfinite(v)) {
        EXPECT_LT(v, top);
      }
    return event->size.height;
  };
  EXPECT_NEAR(second(true), second(false), 0.015);
}

TEST(SitePiles, AMapThatContradictsThePileIsTheGround) {
  const auto piles = make_site_piles(scene_at_site(), {}, 2, 0.2);
  const auto first = piles->release(level_ground(), 0.02);
  const auto second = piles->release(level_ground(0.9F), 0.02);  // somebody has dug there
  EXPECT_EQ(second->news, PileNews::contradicted);
  float lowest = 2;
  for (const float z : second->patch.layer(layer::ground))
    if (std::isfinite(z)) lowest = std::min(lowest, z);
  EXPECT_NEAR(lowest, 0.9, 1e-5);
  EXPECT_NEAR(volume(second->patch), volume(first->patch), 0.5 * volume(first->patch)) << "one slab, not two";
}

TEST(SitePiles, CanBeForgotten) {
  const auto piles = make_site_piles(scene_at_site(), {}, 2, 0.2);
  piles->release(level_ground(), 0.02);
  piles->forget();
  EXPECT_EQ(piles->release(level_ground(), 0.02)->news, PileNews::none);
}

TEST(SitePiles, WatchMayEndIt) {
  const auto piles = make_site_piles(scene_at_site(), {}, 2, 0.2);
  EXPECT_FALSE(piles->release(level_ground(), 0.02, [](const SiteMoment& m) { return m.time < 0.1; }));
}

TEST(SitePiles, RefuseWhatIsNotPossible) {
  const auto piles = make_site_piles(scene_at_site(), {}, 2, 0.2);
  EXPECT_EQ(error_of([&] { piles->release(level_ground(), 0); }),
            "slide: thickness of the slab is 0, must be positive");
  EXPECT_NE(error_of([&] {
              piles->release(level_ground(1.3F), 0.02);
            }).find("slide: the lower side of the panel above the ground is -"),
            std::string::npos);
  EXPECT_EQ(error_of([] { make_site_piles(scene_at_site(), {}, 4, 0.2); }),
            "slide: number of dimensions is 4, must be 2 or 3");
  EXPECT_EQ(error_of([] { make_site_piles(scene_at_site(), {}, 2, -1); }),
            "slide: model error is -1, must be at least 0");
  EXPECT_EQ(piles->release(level_ground(), 0.02)->number, 1) << "it goes on";
}

TEST(SitePiles, AHillUnderThePanelIsSeen) {
  SlideScene scene = scene_at_site();
  HeightMap hill = level_ground();
  const GridGeometry& grid = hill.geometry();
  for (std::size_t k = 0; k < grid.size(); ++k)
    if (std::abs(grid.x(grid.cell_at(k).x)) < 0.02) hill.layer(layer::elevation)[k] = 1.32F;
  scene.ground = hill;
  EXPECT_NE(error_of([&] { check(scene, 2); }).find("lower side of the panel"), std::string::npos);
  EXPECT_NE(error_of([&] { check(scene, 3); }).find("lower side of the panel"), std::string::npos);
}

}  // namespace
}  // namespace aeolian
