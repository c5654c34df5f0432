#include <algorithm>
#include <cmath>
#include <vector>

#include "bar_face.hpp"
#include "bar_shadow.hpp"
#include "bed_table.hpp"
#include "grain_texture.hpp"
#include "image_formation.hpp"
#include "lens.hpp"
#include "scene_frames.hpp"
#include "shadow_scene.hpp"
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>

#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

namespace {

constexpr int edge_samples = 16;        // of a pixel that a border may cross
constexpr double least_descent = 0.05;  // of a ray that reaches the bed, per length; flatter ones see none

struct Light {
  Eigen::Vector3d level;
  Eigen::Vector3d straightedge;
  double strength;  // share of the direct light
};

/// Casts the rays of one photograph.
class Caster {
 public:
  explicit Caster(const ShadowScene& scene);
  cv::Mat cast() const;

 private:
  struct Hit {
    Eigen::Vector3d point;   // on the smooth bed
    Eigen::Vector3d normal;  // (-slope x, -slope y, 1)
  };
  struct Facet {  // the bed in a pixel, as plane and as lit
    Hit hit;
    double over;  // normal . (point - eye)
    BarShadow::Sky sky;
    double skylight;
    double direct[2] = {};  // of each light, unshadowed
  };
  struct Pixel {
    Eigen::Vector3d ray;     // level frame
    Eigen::Vector3d across;  // change of the ray from pixel to pixel
    Eigen::Vector3d down;

    /// One of `edge_samples` rays: stratified over the pixel, and no two of them in line with its sides, so
    /// that a border along rows or columns is placed as well as any other.
    Eigen::Vector3d sample(int i) const {
      const int column = i % 4;
      const int row = i / 4;
      return ray + ((column + (row + 0.5) / 4) / 4 - 0.5) * across +
             ((row + (column + 0.5) / 4) / 4 - 0.5) * down;
    }
  };

  void cast_row(int row, float* out) const;
  Hit meet_bed(const Eigen::Vector3d& ray, double guess) const;
  double bed_light(const Pixel& pixel, const Hit& hit) const;
  Facet facet(const Hit& hit) const;
  double grain_light(const Eigen::Vector3d& ray, const Facet& facet, bool at_border) const;
  double relief(const GrainTexture::Grain& grain, const Light& light) const;
  bool meets_box(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, double margin, double* distance,
                 int* face) const;
  bool inside_plain_face(const Eigen::Vector3d& ray, double margin) const;
  double box_light(const Eigen::Vector3d& point, int face) const;
  bool meets_post(const Eigen::Vector3d& ray, double* light) const;
  bool nears_post(const Eigen::Vector3d& ray, double margin) const;
  Eigen::AlignedBox2d seen_area() const;
  double table_spacing(const Eigen::AlignedBox2d& area) const;

  const ShadowScene& scene_;
  Lens lens_;
  Eigen::Matrix3d to_straightedge_;
  Eigen::Matrix3d camera_to_level_;
  Eigen::Vector3d eye_;  // level frame
  Eigen::Vector3d eye_straightedge_;
  Eigen::AlignedBox3d box_;
  BarShadow shadow_;
  BarFace face_;
  GrainTexture grains_;
  bool fine_grains_;  // large enough for their shape to be seen
  std::vector<Light> lights_;
  double level_light_;  // direct light on level ground over its part along the ray
  BedTable bed_;
};

Caster::Caster(const ShadowScene& scene)
    : scene_(scene),
      lens_(scene.camera),
      to_straightedge_(level_to_straightedge(scene)),
      camera_to_level_(scene.level_to_camera.linear().transpose()),
      eye_(scene.level_to_camera.inverse().translation()),
      eye_straightedge_(to_straightedge_ * eye_),
      box_(Eigen::Vector3d(scene.from, scene.shadow_side > 0 ? -scene.width : 0, -scene.thickness),
           Eigen::Vector3d(scene.to, scene.shadow_side > 0 ? 0 : scene.width, 0)),
      shadow_(scene),
      face_(scene),
      grains_(scene.grain_diameter, scene.seed),
      fine_grains_(scene.grain_diameter > 1.4 * eye_.z() / scene.camera.fx),
      level_light_((1 - scene.skylight) / std::sin(scene.elevation)),
      bed_(scene.bed, seen_area(), table_spacing(seen_area())) {
  std::vector<double> azimuths{scene.azimuth};
  if (scene.second_light_azimuth) azimuths.push_back(*scene.second_light_azimuth);
  for (const double azimuth : azimuths) {
    const Eigen::Vector3d direction = to_light(scene, azimuth);
    lights_.push_back({direction, to_straightedge_ * direction, 1.0 / static_cast<double>(azimuths.size())});
  }
}

Eigen::AlignedBox2d Caster::seen_area() const {
  const double low = scene_.bed(eye_.x(), eye_.y());
  Eigen::AlignedBox2d area;
  for (int i = 0; i <= 40; ++i) {
    for (const auto& [x, y] : {std::pair{i / 40.0, 0.0}, {i / 40.0, 1.0}, {0.0, i / 40.0}, {1.0, i / 40.0}}) {
      const Eigen::Vector2d pixel{x * scene_.camera.width_px, y * scene_.camera.height_px};
      const Eigen::Vector3d ray = camera_to_level_ * lens_.direction(pixel).homogeneous();
      const double descent = std::max(-ray.z(), least_descent * ray.norm());
      double depth = eye_.z() - low;
      for (int round = 0; round < 12; ++round) {
        const Eigen::Vector3d point = eye_ + ray * (depth / descent);
        depth = std::max(0.0, eye_.z() - scene_.bed(point.x(), point.y()));
        area.extend(point.head<2>());
      }
    }
  }
  return area;
}

double Caster::table_spacing(const Eigen::AlignedBox2d& area) const {
  constexpr double most_entries = 5e6;
  const double pixel = eye_.z() / scene_.camera.fx;
  return std::max(2 * pixel, std::sqrt(area.volume() / most_entries));
}

Caster::Hit Caster::meet_bed(const Eigen::Vector3d& ray, double guess) const {
  double t = (guess - eye_.z()) / ray.z();
  Hit hit;
  for (int round = 0; round < 20; ++round) {
    hit.point = eye_ + t * ray;
    const BedTable::Surface surface = bed_.at(hit.point.x(), hit.point.y());
    hit.normal = {-surface.slope_x, -surface.slope_y, 1};
    const double over = hit.point.z() - surface.height;
    const double slope = std::min(hit.normal.dot(ray), 0.3 * ray.z());
    const double step = -over / slope;
    t += step;
    hit.point += step * ray;
    // Newton's next error is about curvature times step squared: far below a micrometre from here.
    if (std::abs(over) < 3e-5) break;
  }
  return hit;
}

bool Caster::meets_box(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray, double margin,
                       double* distance, int* face) const {
  double enter = 0;
  double leave = 1e9;
  for (int axis = 0; axis < 3; ++axis) {
    const double inverse = 1 / (ray[axis] == 0 ? 1e-300 : ray[axis]);
    double near = (box_.min()[axis] - margin - origin[axis]) * inverse;
    double far = (box_.max()[axis] + margin - origin[axis]) * inverse;
    if (near > far) std::swap(near, far);
    if (near > enter) {
      enter = near;
      *face = axis;
    }
    leave = std::min(leave, far);
  }
  *distance = enter;
  return enter < leave;
}

/// Whether all of a pixel is one plain piece of the top face, so that one ray tells its light.
bool Caster::inside_plain_face(const Eigen::Vector3d& ray, double margin) const {
  const Eigen::Vector2d at = (eye_straightedge_ - ray * (eye_straightedge_.z() / ray.z())).head<2>();
  const Eigen::Vector2d border{margin, margin};
  return (at - border - box_.min().head<2>()).minCoeff() > 0 &&
         (box_.max().head<2>() - at - border).minCoeff() > 0 && face_.plain(at, margin);
}

double Caster::box_light(const Eigen::Vector3d& point, int face) const {
  const double side = point[face] * 2 > box_.min()[face] + box_.max()[face] ? 1 : -1;
  double direct = 0;
  for (const Light& light : lights_)
    direct += light.strength * std::max(0.0, side * light.straightedge[face]);
  const double albedo = face == 2 && side > 0 ? face_.albedo(point.head<2>()) : BarFace::metal;
  const double sky = face == 2 ? (side > 0 ? 1.0 : 0.1) : 0.5;  // an upright face sees half the sky
  return albedo / scene_.albedo * (scene_.skylight * sky + level_light_ * direct);
}

bool Caster::meets_post(const Eigen::Vector3d& ray, double* light) const {
  if (!scene_.post_height) return false;
  const Eigen::Vector3d r = to_straightedge_ * ray;
  const Eigen::Vector2d from = eye_straightedge_.head<2>() - Eigen::Vector2d(scene_.post_x, 0);
  const double a = r.head<2>().squaredNorm();
  const double b = from.dot(r.head<2>());
  const double radius2 = BarShadow::post_radius * BarShadow::post_radius;
  const double root2 = b * b - a * (from.squaredNorm() - radius2);
  if (root2 < 0) return false;
  const double at_top = (*scene_.post_height - eye_straightedge_.z()) / r.z();
  if (at_top > 0 && (from + at_top * r.head<2>()).squaredNorm() < radius2) {
    *light = 0.5;
    return true;
  }
  const double t = (-b - std::sqrt(root2)) / a;
  const double z = eye_straightedge_.z() + t * r.z();
  if (t <= 0 || z < 0 || z > *scene_.post_height) return false;
  const Eigen::Vector2d outwards = (from + t * r.head<2>()) / BarShadow::post_radius;
  double direct = 0;
  for (const Light& l : lights_) direct += l.strength * std::max(0.0, outwards.dot(l.straightedge.head<2>()));
  *light = 0.12 / scene_.albedo * (scene_.skylight * 0.5 + level_light_ * direct);
  return true;
}

bool Caster::nears_post(const Eigen::Vector3d& ray, double margin) const {
  if (!scene_.post_height) return false;
  const Eigen::Vector3d r = to_straightedge_ * ray;
  const Eigen::Vector2d from = eye_straightedge_.head<2>() - Eigen::Vector2d(scene_.post_x, 0);
  const double a = r.head<2>().squaredNorm();
  const double b = from.dot(r.head<2>());
  const double radius = BarShadow::post_radius + margin;
  const double root2 = b * b - a * (from.squaredNorm() - radius * radius);
  if (root2 < 0) return false;
  const auto [low, high] = std::minmax({eye_straightedge_.z() + (-b - std::sqrt(root2)) / a * r.z(),
                                        eye_straightedge_.z() + (-b + std::sqrt(root2)) / a * r.z()});
  return high > -margin && low < *scene_.post_height + margin;
}

Caster::Facet Caster::facet(const Hit& hit) const {
  Facet facet;
  facet.hit = hit;
  facet.sky = shadow_.sky(to_straightedge_ * hit.point);
  facet.skylight = scene_.skylight * (1 - facet.sky.blocked_skylight);
  facet.over = hit.normal.dot(hit.point - eye_);
  const double size = hit.normal.norm();
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    facet.direct[i] =
        lights_[i].strength * level_light_ * std::max(0.0, hit.normal.dot(lights_[i].level)) / size;
  }
  return facet;
}

double Caster::grain_light(const Eigen::Vector3d& ray, const Facet& facet, bool at_border) const {
  const double inverse = 1 / facet.hit.normal.dot(ray);
  Eigen::Vector3d point = eye_ + facet.over * inverse * ray;
  const GrainTexture::Grain grain =
      fine_grains_ ? grains_.at(point.x(), point.y()) : grains_.shapeless_at(point.x(), point.y());
  const double albedo = std::max(0.1, 1 + scene_.albedo_contrast * grain.albedo);
  const double height = std::clamp(scene_.roughness * grain.height, -0.5, 0.5);
  double light = facet.skylight * (1 + 0.15 * height);
  if (at_border) {
    point += height * scene_.grain_diameter * inverse * ray;
    const Eigen::Vector3d in_straightedge = to_straightedge_ * point;
    const BarShadow::Sky here = shadow_.sky(in_straightedge);
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      light += facet.direct[i] * relief(grain, lights_[i]) *
               shadow_.seen_past_box(here, lights_[i].straightedge) *
               shadow_.seen_past_post(in_straightedge, lights_[i].straightedge);
    }
  } else {
    for (std::size_t i = 0; i < lights_.size(); ++i) {
      if (facet.direct[i] > 0) light += facet.direct[i] * relief(grain, lights_[i]);
    }
  }
  return albedo * light;
}

double Caster::relief(const GrainTexture::Grain& grain, const Light& light) const {
  // A grain is brighter on the side that faces the light.
  return 1 + 0.6 * scene_.roughness * (grain.x * light.level.x() + grain.y * light.level.y());
}

double Caster::bed_light(const Pixel& pixel, const Hit& hit) const {
  Facet lit = facet(hit);
  const Eigen::Vector3d in_straightedge = to_straightedge_ * hit.point;
  const double pixel_size = (hit.point - eye_).norm() * pixel.across.norm();
  const double reach = 2 * (pixel_size + scene_.grain_diameter * std::min(1.0, 4 * scene_.roughness));
  const double margin = scene_.sun_diameter / 2 + 1e-6 + reach / lit.sky.nearest;
  bool at_border = false;
  for (std::size_t i = 0; i < lights_.size() && !at_border; ++i) {
    const BarShadow::Angles angles = shadow_.angles(lit.sky, lights_[i].straightedge);
    const double past = std::max(angles.past_edge, angles.past_end);
    at_border = std::abs(past) < margin ||
                (past > 0 && shadow_.near_post(in_straightedge, lights_[i].straightedge, reach));
    if (past < 0 && !at_border) lit.direct[i] = 0;
  }
  if (at_border) {
    lit = facet(hit);
    double sum = 0;
    for (int i = 0; i < edge_samples; ++i) sum += grain_light(pixel.sample(i), lit, true);
    return sum / edge_samples;
  }
  if (pixel_size < 0.6 * scene_.grain_diameter) return grain_light(pixel.ray, lit, false);
  double sum = 0;
  for (const double right : {-0.25, 0.25}) {
    for (const double below : {-0.25, 0.25}) {
      sum += grain_light(pixel.ray + right * pixel.across + below * pixel.down, lit, false);
    }
  }
  return sum / 4;
}

void Caster::cast_row(int row, float* out) const {
  const int width = scene_.camera.width_px;
  const std::vector<Eigen::Vector2d> here = lens_.row(row);
  const std::vector<Eigen::Vector2d> below = lens_.row(row + 1);
  double guess = scene_.bed(eye_.x(), eye_.y());
  for (int column = 0; column < width; ++column) {
    const Eigen::Vector2d* d = here.data() + column + 1;
    Pixel pixel;
    pixel.ray = camera_to_level_ * d->homogeneous();
    pixel.across = camera_to_level_.leftCols<2>() * ((d[1] - d[-1]) / 2);
    pixel.down = camera_to_level_.leftCols<2>() * (below[static_cast<std::size_t>(column + 1)] - *d);
    const bool sees_bed = pixel.ray.z() < -least_descent * pixel.ray.norm();
    Hit hit;
    if (sees_bed) {
      hit = meet_bed(pixel.ray, guess);
      guess = hit.point.z();
    }
    const Eigen::Vector3d ray_straightedge = to_straightedge_ * pixel.ray;
    double distance = 0;
    int face = 0;
    const double footprint = 2 * pixel.across.norm() * std::max(eye_straightedge_.norm(), eye_.z());
    double light = 0;
    const bool near_post = scene_.post_height && nears_post(pixel.ray, footprint);
    if (!near_post && inside_plain_face(ray_straightedge, footprint)) {
      meets_box(eye_straightedge_, ray_straightedge, 0, &distance, &face);
      light = box_light(eye_straightedge_ + distance * ray_straightedge, face);
    } else if (near_post || meets_box(eye_straightedge_, ray_straightedge, footprint, &distance, &face)) {
      for (int sample = 0; sample < edge_samples; ++sample) {
        const Eigen::Vector3d ray = pixel.sample(sample);
        double sampled = 0;
        const Eigen::Vector3d turned = to_straightedge_ * ray;
        if (meets_post(ray, &sampled)) {
          light += sampled;
        } else if (meets_box(eye_straightedge_, turned, 0, &distance, &face)) {
          light += box_light(eye_straightedge_ + distance * turned, face);
        } else if (sees_bed) {
          light += grain_light(ray, facet(hit), true);
        }
      }
      light /= edge_samples;
    } else {
      light = sees_bed ? bed_light(pixel, hit) : 1.0;
    }
    out[column] = static_cast<float>(light);
  }
}

cv::Mat Caster::cast() const {
  cv::Mat light(scene_.camera.height_px, scene_.camera.width_px, CV_32F);
  cv::parallel_for_({0, light.rows}, [&](const cv::Range& rows) {
    for (int row = rows.start; row < rows.end; ++row) cast_row(row, light.ptr<float>(row));
  });
  return light;
}

/// Exposure and the slow change of the light over the frame.
void light_up(const ShadowScene& scene, cv::Mat* light) {
  const double direction = 2 * M_PI * RandomStream(scene.seed, 1).uniform();
  const double size = std::hypot(light->cols, light->rows);
  for (int row = 0; row < light->rows; ++row) {
    float* values = light->ptr<float>(row);
    for (int column = 0; column < light->cols; ++column) {
      const double along = ((column - light->cols / 2.0) * std::cos(direction) +
                            (row - light->rows / 2.0) * std::sin(direction)) /
                           size;
      values[column] *= static_cast<float>(scene.exposure * (1 + scene.uneven_light * along));
    }
  }
}

cv::Mat values_of(const ShadowScene& scene) {
  cv::Mat light = Caster(scene).cast();
  light_up(scene, &light);
  return expose(scene, std::move(light));
}

}  // namespace

Photo photograph(const ShadowScene& scene) {
  cv::Mat values = values_of(scene);
  if (scene.jpeg_quality > 0) values = through_jpeg(values, scene.jpeg_quality);
  Photo photo;
  photo.width_px = values.cols;
  photo.height_px = values.rows;
  photo.exif_focal_px = scene.exif_focal_px;
  photo.values8.assign(values.datastart, values.dataend);
  return photo;
}

void write_jpeg(const ShadowScene& scene, const std::string& path) {
  const int quality = scene.jpeg_quality > 0 ? scene.jpeg_quality : 100;
  if (!cv::imwrite(path, sand_coloured(values_of(scene)), {cv::IMWRITE_JPEG_QUALITY, quality})) {
    throw Error("photo " + path + ": cannot be written");
  }
}

}  // namespace aeolian
