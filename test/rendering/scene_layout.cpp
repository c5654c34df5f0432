#include "scene_layout.hpp"

#include <algorithm>
#include <cmath>

#include "scene_frames.hpp"

namespace aeolian {

namespace {

constexpr int stations = 160;

Eigen::Vector3d bed_normal(const ShadowScene& scene, double x, double y) {
  constexpr double h = 1e-5;
  return Eigen::Vector3d((scene.bed(x - h, y) - scene.bed(x + h, y)) / (2 * h),
                         (scene.bed(x, y - h) - scene.bed(x, y + h)) / (2 * h), 1)
      .normalized();
}

double distance_to_segment(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const double t = std::clamp((p - a).dot(b - a) / std::max((b - a).squaredNorm(), 1e-12), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

}  // namespace

bool in_frame(const CameraModel& camera, const Eigen::Vector2d& pixel, double margin_px) {
  return pixel.x() >= margin_px && pixel.y() >= margin_px && pixel.x() <= camera.width_px - 1 - margin_px &&
         pixel.y() <= camera.height_px - 1 - margin_px;
}

std::pair<double, double> facet_light(const ShadowScene& scene, double middle, double reach) {
  const Eigen::Vector3d light = to_light(scene, scene.azimuth);
  double least = 10;
  double most = 0;
  for (int i = 0; i <= 400; ++i) {
    for (const double y : {-0.3 * reach, 0.3 * reach}) {
      const double facing = bed_normal(scene, middle + (i / 200.0 - 1) * reach, y).dot(light) / light.z();
      least = std::min(least, facing);
      most = std::max(most, facing);
    }
  }
  return {least, most};
}

SceneLayout lay_out(const ShadowScene& scene, double middle, double reach, double margin_px) {
  const Eigen::Matrix3d to_straightedge = level_to_straightedge(scene);
  const Eigen::Vector3d light = to_straightedge * to_light(scene, scene.azimuth);
  const Eigen::Vector3d plane = light.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d eye = scene.level_to_camera.inverse().translation();
  const double back = -scene.shadow_side * scene.width;
  const auto seen = [&](const Eigen::Vector3d& in_straightedge) {
    const Eigen::Vector3d point = to_straightedge.transpose() * in_straightedge;
    if ((scene.level_to_camera * point).z() < 0.01) return Eigen::Vector2d(-1e6, -1e6);
    return true_pixel(scene, point);
  };
  SceneLayout layout{0, 0, 1e6, 1, 1};
  bool any = false;
  std::vector<Eigen::Vector2d> outline[4];
  std::vector<Eigen::Vector2d> border;
  for (int i = 0; i <= stations; ++i) {
    const double x = middle + (2.0 * i / stations - 1) * reach;
    if (x < scene.from || x > scene.to) continue;
    const Eigen::Vector2d corners[4] = {seen({x, 0, 0}), seen({x, back, 0}), seen({x, 0, -scene.thickness}),
                                        seen({x, back, -scene.thickness})};
    for (int k = 0; k < 4; ++k) outline[k].push_back(corners[k]);
    const Eigen::Vector3d point = true_bed_point(scene, x);
    const Eigen::Vector3d at = to_straightedge * point;
    const double cast_from = at.x() + std::abs(at.y() / light.y()) * light.x();
    const Eigen::Vector2d pixel = seen(at);
    const bool good =
        cast_from > scene.from && cast_from < scene.to && in_frame(scene.camera, pixel, margin_px) &&
        in_frame(scene.camera, corners[0], margin_px) && in_frame(scene.camera, corners[1], margin_px);
    if (!good) {
      if (any && layout.to - layout.from > reach / 4) break;  // a part this long is the one; else go on
      any = false;
      border.clear();
      continue;
    }
    if (!any) layout.from = x;
    any = true;
    layout.to = x;
    border.push_back(pixel);
    const Eigen::Vector3d view = (eye - point).normalized();
    layout.least_crossing = std::min(layout.least_crossing, std::abs(plane.dot(to_straightedge * view)));
    layout.least_view = std::min(layout.least_view, bed_normal(scene, point.x(), point.y()).dot(view));
    // Seen from the eye, the border must lie on the shadow's side of the straightedge.
    const Eigen::Vector3d over = to_straightedge * eye;
    const double t = (at.z()) / (at.z() - over.z());
    if ((at.y() + t * (over.y() - at.y())) * scene.shadow_side < 0) layout.least_gap_px = 0;
  }
  for (const auto& line : outline) {
    for (const Eigen::Vector2d& pixel : border) {
      for (std::size_t i = 1; i < line.size(); ++i) {
        if (line[i].x() < -1e5 || line[i - 1].x() < -1e5) continue;
        layout.least_gap_px = std::min(layout.least_gap_px, distance_to_segment(pixel, line[i - 1], line[i]));
      }
    }
  }
  if (!any && border.empty()) layout.from = layout.to = 0;
  return layout;
}

}  // namespace aeolian
