#include "aeolian_core/slide/piles/slide_series.hpp"

#include <cmath>

#include "../../error_of.hpp"
#include <gtest/gtest.h>

namespace aeolian {
namespace {

/// The laboratory's scene as coarse as the thesis has it, on a smoother panel, of
/// softer snow: quick.
SlideScene small_scene() {
  SlideScene scene;
  scene.cell = 0.01;
  scene.threads = 1;
  scene.panel_friction = 0.4;
  scene.snow.youngs_modulus = 2.5e5;  // twice as long steps
  return scene;
}

TEST(SlideSeries, PilesGrowFromEventToEvent) {
  SlideSeries<2> series(small_scene());
  const auto first = series.next();
  const auto second = series.next();
  const double slab = 210 * 0.245 * 0.02;
  EXPECT_NEAR(first->mass + first->left_behind, slab, 1e-12);
  EXPECT_NEAR(second->mass + second->left_behind, first->mass + slab, 1e-12);
  EXPECT_TRUE(first->still);
  EXPECT_EQ(second->number, 2);
  EXPECT_GT(second->pile.height, first->pile.height);
  EXPECT_LT(second->pile.head, first->pile.head + 0.01);  // it grows towards the panel
  // It lands where a block would: beyond the panel's edge and within reach of a frictionless fall.
  EXPECT_GT(first->pile.tail, 0.5 * 0.245 * std::cos(small_scene().tilt));
  EXPECT_LT(first->pile.tail, 0.8);
  for (const auto& p : second->snow) EXPECT_GT(p.place[1], -0.01);
}

TEST(SlideSeries, SeedDecides) {
  const auto height = [](std::uint64_t seed) {
    SlideScene scene = small_scene();
    scene.seed = seed;
    return SlideSeries<2>(scene).next()->pile.height;
  };
  EXPECT_EQ(height(1), height(1));
  EXPECT_NE(height(1), height(2));
}

// Trap 8 of the specification: mass is kept exactly, particles are fresh.
TEST(SlideSeries, ReseedingKeepsMass) {
  SlideScene scene = small_scene();
  scene.between = SlideScene::Between::reseed;
  SlideSeries<2> series(scene);
  const auto first = series.next();
  const auto second = series.next();
  EXPECT_NEAR(second->mass + second->left_behind, first->mass + 210 * 0.245 * 0.02, 1e-12);
}

TEST(SlideSeries, ThreeDimensions) {
  SlideScene scene = small_scene();
  scene.panel_length = 0.1;
  scene.slab_width = 0.06;
  scene.panel_width = 0.1;
  scene.panel_height = 0.15;
  scene.particles_per_cell = 6;
  const auto event = SlideSeries<3>(scene).next();
  EXPECT_NEAR(event->mass + event->left_behind, 210 * 0.1 * 0.06 * 0.02, 1e-12);
  const HeightMap map = pile_map<3>(scene, event->snow, 0.01);
  EXPECT_TRUE(map.has(layer::variance));
  float top = 0;
  for (const float z : map.layer(layer::elevation)) top = std::max(top, z);
  EXPECT_NEAR(top, event->pile.height, 0.02);
}

TEST(SlideSeries, GroundMayBeAMap) {
  SlideScene scene = small_scene();
  HeightMap ground(GridGeometry(-1, -0.5, 0.05, 60, 20));
  ground.add(layer::elevation, 0.05F);
  scene.ground = ground;
  scene.panel_height = 0.38;
  const auto raised = SlideSeries<2>(scene).next();
  scene.ground.reset();
  scene.panel_height = 0.33;
  const auto level = SlideSeries<2>(scene).next();
  EXPECT_NEAR(raised->pile.height, level->pile.height, 0.01);  // above its ground
  EXPECT_NEAR(raised->pile.tail, level->pile.tail, 0.05);
  double lowest = 1;
  for (const auto& p : raised->snow) lowest = std::min(lowest, p.place[1]);
  EXPECT_GT(lowest, 0.045);
}

TEST(SlideSeries, WatchMayEndIt) {
  SlideSeries<2> series(small_scene());
  int looks = 0;
  EXPECT_FALSE(series.next([&](const SlideMoment<2>&) { return ++looks < 3; }));
  EXPECT_EQ(looks, 3);
  EXPECT_EQ(series.next()->number, 1);
}

// 30 degrees must not slide at a friction of 0.7, 40 must (specification, section 5 B).
TEST(SlideSeries, StuckSlabIsTold) {
  SlideScene scene = small_scene();
  scene.tilt = 30 * M_PI / 180;
  scene.panel_friction = 0.7;
  EXPECT_NE(error_of([&] { SlideSeries<2>(scene).next(); }).find("is stuck on the panel"), std::string::npos);
}

TEST(SlideSeries, RefusesScenesThatAreNotPossible) {
  const auto told = [](auto change) {
    SlideScene scene = small_scene();
    change(scene);
    return error_of([&] { SlideSeries<2>{scene}; });
  };
  EXPECT_EQ(told([](SlideScene& s) { s.slab_thickness = 0; }),
            "slide: thickness of the slab is 0, must be positive");
  EXPECT_NE(
      told([](SlideScene& s) { s.panel_height = 0.05; }).find("lower side of the panel above the ground"),
      std::string::npos);
  EXPECT_NE(told([](SlideScene& s) { s.tilt = 2; }).find("slide: tilt is 114.592"), std::string::npos);
  EXPECT_NE(told([](SlideScene& s) { s.cell = 0.05; }).find("at most the thickness"), std::string::npos);
  EXPECT_EQ(told([](SlideScene& s) { s.snow.cohesion = -1; }), "snow: beta is -1, must be from 0 to 10");
  const auto unknown = [](SlideScene& s) {
    s.ground = HeightMap(GridGeometry(-1, -1, 1, 2, 2));
    s.ground->add(layer::elevation, 0);
    s.ground->layer(layer::elevation)[3] = HeightMap::unknown;
  };
  EXPECT_EQ(told(unknown), "ground: elevation of cell (1, 1) is not known, must be finite everywhere");
}

}  // namespace
}  // namespace aeolian
