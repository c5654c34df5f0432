#include "shadow_scene.hpp"

#include <cmath>

#include "lens.hpp"
#include "scene_frames.hpp"

namespace aeolian {

Eigen::Vector3d true_bed_point(const ShadowScene& scene, double x) {
  const Eigen::Matrix3d from_straightedge = level_to_straightedge(scene).transpose();
  const Eigen::Vector3d light = from_straightedge.transpose() * to_light(scene, scene.azimuth);
  const double fall = light.z() / std::abs(light.y());  // of the plane of light, per length across
  const auto on_plane = [&](double across) -> Eigen::Vector3d {
    return from_straightedge * Eigen::Vector3d(x, scene.shadow_side * across, -fall * across);
  };
  const auto over_bed = [&](double across) {
    const Eigen::Vector3d point = on_plane(across);
    return point.z() - scene.bed(point.x(), point.y());
  };
  // Outwards in steps that would end at a level bed, until the first point below it; then halving.
  double before = 0;
  double after = 0;
  for (int step = 0; step < 2000; ++step) {
    const double height = over_bed(after);
    if (height <= 0) break;
    before = after;
    after += std::max(height, 1e-6) / fall * 0.7;
  }
  for (int step = 0; step < 60; ++step) {
    const double middle = (before + after) / 2;
    (over_bed(middle) > 0 ? before : after) = middle;
  }
  return on_plane((before + after) / 2);
}

Eigen::Vector3d true_tip_shadow(const ShadowScene& scene) {
  const Eigen::Vector3d tip = level_to_straightedge(scene).transpose() *
                              Eigen::Vector3d(scene.post_x, 0, scene.post_height.value_or(0));
  const Eigen::Vector3d light = to_light(scene, scene.azimuth);
  double travelled = 0;
  for (int step = 0; step < 2000; ++step) {
    const Eigen::Vector3d point = tip - travelled * light;
    const double height = point.z() - scene.bed(point.x(), point.y());
    if (std::abs(height) < 1e-12) break;
    travelled += 0.7 * height / light.z();  // short steps: the bed may rise or fall along the ray
  }
  return tip - travelled * light;
}

Eigen::Vector2d true_pixel(const ShadowScene& scene, const Eigen::Vector3d& point) {
  return Lens(scene.camera).pixel((scene.level_to_camera * point).hnormalized());
}

}  // namespace aeolian
