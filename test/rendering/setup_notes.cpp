#include "setup_notes.hpp"

#include <algorithm>
#include <cmath>

#include "almanac.hpp"
#include "lens.hpp"
#include "scene_frames.hpp"

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {

namespace {

Eigen::Vector2d blur(const Eigen::Vector2d& pixel, double sigma, RandomStream* random) {
  const double x = random->normal();
  return pixel + sigma * Eigen::Vector2d(x, random->normal());
}

Eigen::Vector2d face_pixel(const ShadowScene& scene, const Eigen::Vector2d& point) {
  return true_pixel(scene,
                    level_to_straightedge(scene).transpose() * Eigen::Vector3d(point.x(), point.y(), 0));
}

/// A horizontal direction as an arrow on the photo, in the frame's middle at the height of the edge [px].
Eigen::Vector2d arrow(const ShadowScene& scene, const Eigen::Vector3d& direction) {
  const Eigen::Isometry3d to_level = scene.level_to_camera.inverse();
  const Eigen::Vector2d middle{(scene.camera.width_px - 1) / 2.0, (scene.camera.height_px - 1) / 2.0};
  const Eigen::Vector3d ray = to_level.linear() * Lens(scene.camera).direction(middle).homogeneous();
  const Eigen::Vector3d at = to_level.translation() - ray * (to_level.translation().z() / ray.z());
  const Eigen::Vector2d step =
      true_pixel(scene, at + 1e-4 * direction) - true_pixel(scene, at - 1e-4 * direction);
  return 100 * step.normalized();
}

/// Height of the edge at scale zero over the plane that fits the section best.
double height_over_mean_plane(const ShadowScene& scene, double from, double to) {
  constexpr int stations = 400;
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (int i = 0; i <= stations; ++i) {
    const double x = from + (to - from) * i / stations;
    const Eigen::Vector2d row{1, x};
    normal += row * row.transpose();
    right += row * true_bed_point(scene, x).z();
  }
  return -Eigen::Vector2d(normal.inverse() * right).x();
}

}  // namespace

SunTime random_sun(RandomStream* random) {
  for (;;) {
    SunTime sun{};
    sun.unix_time = std::floor(-6.3e8 + 2.7e9 * random->uniform());  // 1950 to 2035
    sun.latitude = (120 * random->uniform() - 60) * degree;
    sun.longitude = (360 * random->uniform() - 180) * degree;
    const AlmanacSun seen = almanac_sun(sun.unix_time, sun.latitude, sun.longitude);
    sun.elevation = seen.elevation;
    sun.azimuth = seen.azimuth;
    if (sun.elevation > 15 * degree && sun.elevation < 55 * degree) return sun;
  }
}

void mark_straightedge(ShadowScene* scene, bool markers, double from, double to) {
  const double side = -scene->shadow_side * scene->width;
  if (!markers) {
    double spacing = 0.002;
    for (const double wider : {0.0025, 0.005, 0.01, 0.02, 0.025, 0.05}) {
      if ((to - from) / wider > 11) spacing = wider;
    }
    const int last = static_cast<int>(std::floor(scene->to / spacing));
    for (int i = static_cast<int>(std::ceil(scene->from / spacing)); i <= last; ++i) {
      for (const double across : {0.1, 0.9}) scene->ticks.emplace_back(i * spacing, across * side);
    }
    return;
  }
  PhotoSetup::Markers strip;
  strip.dictionary = "DICT_4X4_50";
  const double length = to - from;
  strip.size = std::floor(1e4 * std::min(0.7 * scene->width, length / (4 * 1.35))) * 1e-4;
  const int count = std::clamp(static_cast<int>(length / (1.35 * strip.size)), 4, 12);
  const double pitch = length / count;
  for (int i = 0; i < count; ++i) {
    const double x = std::round(1e4 * (from + (i + 0.5) * pitch)) * 1e-4;
    strip.centres.push_back({i, {x, std::round(1e4 * side / 2) * 1e-4}});
  }
  scene->markers = strip;
}

PhotoSetup take_notes(const ShadowScene& scene, const SceneLayout& layout, const NoteTaking& notes,
                      const SunTime& sun, int downwind, RandomStream* random) {
  PhotoSetup setup;
  if (notes.calibrated) setup.camera = scene.camera;
  setup.inclination = scene.inclination;
  setup.markers = scene.markers;
  for (const Eigen::Vector2d& tick : scene.ticks) {
    if (tick.x() < layout.from || tick.x() > layout.to) continue;
    setup.scale.push_back({blur(face_pixel(scene, tick), 0.1, random), tick.x(), tick.y()});
  }
  if (notes.line) {
    for (const double share : {0.05, 0.35, 0.65, 0.95}) {
      const double x = layout.from + share * (layout.to - layout.from);
      setup.line_px.push_back(blur(face_pixel(scene, {x, 0}), 0.3, random));
    }
  }
  if (notes.height) setup.height = height_over_mean_plane(scene, layout.from, layout.to);
  switch (notes.light) {
    case LightNote::angles: {
      const double elevation = scene.elevation + 0.1 * degree * random->normal();
      setup.light = PhotoSetup::Angles{elevation, scene.azimuth + 0.1 * degree * random->normal()};
      break;
    }
    case LightNote::post: {
      PhotoSetup::Post post;
      post.height = *scene.post_height;
      post.base_px = blur(face_pixel(scene, {scene.post_x, 0}), 0.3, random);
      post.tip_px = blur(true_pixel(scene, true_tip_shadow(scene)), 0.3, random);
      setup.light = post;
      break;
    }
    case LightNote::sun: {
      // The sun stands clockwise of north by its azimuth; north is as far the other way from the sun,
      const Eigen::Vector3d towards = to_light(scene, scene.azimuth);
      // drawn to half a degree.
      const double drawn = sun.azimuth + 0.5 * degree * random->normal();
      const Eigen::Vector3d north = Eigen::AngleAxisd(drawn, Eigen::Vector3d::UnitZ()) *
                                    Eigen::Vector3d(towards.x(), towards.y(), 0).normalized();
      setup.light = PhotoSetup::Sun{sun.unix_time, sun.latitude, sun.longitude, arrow(scene, north)};
      break;
    }
  }
  setup.grain_diameter = scene.grain_diameter * (1 + 0.05 * (2 * random->uniform() - 1));
  if (notes.wind) setup.wind_px = arrow(scene, Eigen::Vector3d(downwind, 0, 0));
  return setup;
}

}  // namespace aeolian
