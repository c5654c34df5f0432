#include "aeolian_core/grains/splash/reptation.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "aeolian_core/grains/grain.hpp"
#include "aeolian_core/grains/splash/splash.hpp"
#include "aeolian_core/grains/splash/surface_roughness.hpp"
#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

TEST(ReptationTest, hops_on_slopes_are_those_of_the_bed_frame) {
  const double slope = 12 * degree, along = 0.3, away = 0.5;  // spec 3.7: (2 vn / g)(vt - vn tan)
  const double x = along * std::cos(slope) - away * std::sin(slope);
  const double z = along * std::sin(slope) + away * std::cos(slope);
  EXPECT_NEAR(hop_length(x, z, slope), 2 * away / gravity * (along - away * std::tan(slope)), 1e-12);
  EXPECT_DOUBLE_EQ(hop_length(1, 1, 0), 2 / gravity);
  EXPECT_EQ(hop_length(1, 0.1, 30 * degree), 0);  // into the bed
}

TEST(ReptationTest, an_event_adds_the_hops_of_its_ejecta) {
  SplashEvent event;
  event.rebound = LeavingGrain{{9, 0, 9}};
  event.ejecta = {{{1, 0, 2}}, {{-0.5, 0, 1}}};
  EXPECT_NEAR(reptation_distance(event, 0), (4 - 1) / gravity, 1e-12);
}

TEST(ReptationTest, thesis_ejecta_turn_about_on_steep_stoss_slopes) {
  // Case B of the thesis, its ejecta flown again on 10 degrees: 55 cm falls to -32 (the thesis has -35).
  EXPECT_NEAR(mean_reptation(0.55, 7, 1.65 * 1.65 + 0.85 * 0.85, 10 * degree), -0.32, 0.005);
}

LeavingGrain from(Origin origin) { return {Eigen::Vector3d::Zero(), 1, 0, origin}; }

TEST(SurfaceRoughnessTest, targets_roughen_and_brinks_smooth) {
  SurfaceRoughness bed(100, 0.1);
  SplashEvent event;
  event.ejecta = {from(Origin::target), from(Origin::target), from(Origin::other)};
  bed.ejected(event);
  EXPECT_NEAR(bed.brinks(), 0.12, 1e-12);
  event.ejecta = {from(Origin::brink), from(Origin::anti_brink), from(Origin::brink)};
  bed.ejected(event);
  EXPECT_NEAR(bed.brinks(), 0.09, 1e-12);
}

TEST(SurfaceRoughnessTest, grains_that_come_to_rest_fill_and_bounds_hold) {
  SurfaceRoughness bed(50, 0.2);
  bed.came_to_rest(1e-3);
  EXPECT_NEAR(bed.brinks(), 0.2 * (1 - 1e-3 / 50), 1e-9);
  bed.came_to_rest(1e6);
  EXPECT_NEAR(bed.brinks(), 0, 1e-12);
  SplashEvent event;
  event.ejecta.assign(1000, from(Origin::target));
  bed.ejected(event);
  EXPECT_EQ(bed.brinks(), SurfaceRoughness::most);
}

TEST(SurfaceRoughnessTest, balance_of_targets_and_filling) {
  SurfaceRoughness bed(200);
  SplashEvent one;
  one.ejecta = {from(Origin::target)};
  for (int i = 0; i < 20000; ++i) {
    bed.ejected(one);
    bed.came_to_rest(5);
  }
  EXPECT_NEAR(bed.brinks(), 1.0 / 5, 0.005);  // as many made as filled
}

TEST(SurfaceRoughnessTest, bad_values_are_refused) {
  EXPECT_THROW(SurfaceRoughness(0), Error);
  EXPECT_THROW(SurfaceRoughness(10, 0.6), Error);
  EXPECT_THROW(SurfaceRoughness(10).came_to_rest(-1), Error);
}

}  // namespace
}  // namespace aeolian
