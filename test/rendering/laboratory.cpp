#include "laboratory.hpp"

#include <algorithm>
#include <cmath>

#include "scene_frames.hpp"
#include "scene_layout.hpp"

namespace aeolian {

SetUp set_up_of(const Laboratory& laboratory) {
  SetUp set_up;
  ShadowScene& scene = set_up.scene;
  scene.bed = laboratory.bed;
  scene.elevation = laboratory.elevation;
  scene.azimuth = laboratory.azimuth;
  scene.inclination = laboratory.inclination;
  scene.grain_diameter = laboratory.grain_diameter;
  scene.exposure = 0.6;
  scene.seed = laboratory.seed;
  scene.camera.width_px = laboratory.width_px;
  scene.camera.height_px = laboratory.height_px;
  scene.camera.fx = scene.camera.fy = laboratory.pixels_per_metre * laboratory.camera_distance;
  scene.camera.cx = (laboratory.width_px - 1) / 2.0;
  scene.camera.cy = (laboratory.height_px - 1) / 2.0;

  const double half = laboratory.width_px / laboratory.pixels_per_metre / 2;
  scene.from = -1.5 * half;
  scene.to = 1.5 * half;
  scene.width = std::min(0.03, 0.6 * half);
  double farthest = 0;
  for (int i = -20; i <= 20; ++i) farthest = std::max(farthest, true_bed_point(scene, i / 20.0 * half).y());
  const Eigen::Vector3d target(0, (farthest - scene.width) / 2, 0);
  const double lean = laboratory.off_nadir / std::sqrt(2.0);
  scene.level_to_camera.linear() =
      (Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitX()) * Eigen::AngleAxisd(lean, Eigen::Vector3d::UnitY()) *
       Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()))
          .toRotationMatrix();
  scene.level_to_camera.translation() =
      Eigen::Vector3d(0, 0, laboratory.camera_distance) - scene.level_to_camera.linear() * target;

  const Eigen::Matrix3d to_level = level_to_straightedge(scene).transpose();
  const double spacing = half / 8;
  for (int i = -12; i <= 12; ++i) {
    for (const double across : {0.1, 0.9}) {
      const Eigen::Vector2d tick(i * spacing, -across * scene.width);
      const Eigen::Vector2d pixel = true_pixel(scene, to_level * Eigen::Vector3d(tick.x(), tick.y(), 0));
      scene.ticks.push_back(tick);
      if (in_frame(scene.camera, pixel, 8)) set_up.setup.scale.push_back({pixel, tick.x(), tick.y()});
    }
  }
  const SceneLayout layout = lay_out(scene, 0, 1.4 * half, 0.006 * laboratory.width_px);
  set_up.from = layout.from;
  set_up.to = layout.to;
  set_up.setup.camera = scene.camera;
  set_up.setup.inclination = scene.inclination;
  set_up.setup.light = PhotoSetup::Angles{scene.elevation, scene.azimuth};
  set_up.setup.grain_diameter = scene.grain_diameter;
  return set_up;
}

}  // namespace aeolian
