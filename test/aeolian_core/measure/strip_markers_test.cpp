#include "aeolian_core/measure/strip_markers.hpp"

#include <cmath>

#include "../../rendering/scene_frames.hpp"
#include "../../rendering/shadow_scene.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

// Corners against the true projection, and along the line from each marker's middle: a blurred square's
// corner must not be drawn inwards.
TEST(StripMarkers, CornersAreGoodToATenthOfAPixel) {
  double distance = 0;
  double outward = 0;
  double corners = 0;
  int photographs = 0;
  for (std::uint64_t seed = 300; photographs < 5; ++seed) {
    const auto set_up = random_set_up(seed, 0.5);
    if (!set_up.setup.markers) continue;
    ++photographs;
    const Eigen::Matrix3d to_level = level_to_straightedge(set_up.scene).transpose();
    const auto pixel = [&](const Eigen::Vector2d& p) {
      return true_pixel(set_up.scene, to_level * Eigen::Vector3d(p.x(), p.y(), 0));
    };
    const auto found = find_markers(photograph(set_up.scene), *set_up.setup.markers);
    EXPECT_GE(found.size(), 4 * (set_up.setup.markers->centres.size() - 1)) << "seed " << seed;
    for (std::size_t i = 0; i < found.size(); i += 4) {
      Eigen::Vector2d middle = Eigen::Vector2d::Zero();
      for (std::size_t k = i; k < i + 4; ++k) middle += found[k].position / 4;
      for (std::size_t k = i; k < i + 4; ++k) {
        const Eigen::Vector2d truth = pixel(found[k].position);
        const Eigen::Vector2d error = found[k].pixel - truth;
        distance += error.norm();
        outward += error.dot((truth - pixel(middle)).normalized());
        ++corners;
      }
    }
  }
  EXPECT_LT(distance / corners, 0.1);
  EXPECT_LT(std::abs(outward / corners), 0.03);
}

TEST(StripMarkers, WhatIsNotThereIsTold) {
  Photo grey;
  grey.width_px = 200;
  grey.height_px = 150;
  grey.values8.assign(200 * 150, 128);
  PhotoSetup::Markers markers{"DICT_4X4_50", 0.02, {{0, {0, -0.015}}}};
  EXPECT_THROW(find_markers(grey, markers), Error);
  markers.dictionary = "DICT_9X9_1";
  EXPECT_THROW(find_markers(grey, markers), Error);
}

}  // namespace
}  // namespace aeolian
