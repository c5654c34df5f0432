#include <algorithm>
#include <cmath>

#include "lens.hpp"
#include "ripple_bed.hpp"
#include "scene_frames.hpp"
#include "scene_layout.hpp"
#include "setup_notes.hpp"
#include "setup_yaml.hpp"
#include "shadow_scene.hpp"

#include "aeolian_core/surface/degree.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/random.hpp"

namespace aeolian {

namespace {

/// Draws one set-up: the kind first, then geometry again and again until everything is in the frame.
class Draw {
 public:
  Draw(std::uint64_t seed, double megapixels);
  SetUp set_up();

 private:
  double uniform(double low, double high) { return low + (high - low) * random_.uniform(); }
  double log_uniform(double low, double high) { return low * std::pow(high / low, random_.uniform()); }
  bool chance(double probability) { return random_.uniform() < probability; }

  void draw_scale_and_light();
  void draw_appearance();
  void draw_lens();
  void draw_straightedge();
  bool draw_bed();
  bool draw_camera();
  bool place_post();
  double wavelength_along_section() const;

  RandomStream random_;
  NoteTaking notes_;
  bool rational_ = false;
  SunTime sun_{};
  ShadowScene scene_;
  RippleBed ripples_;
  SceneLayout layout_;
  double pixels_per_metre_ = 0;
  bool upright_ = false;  // the straightedge runs along the frame's columns
  double reach_ = 0;      // half of what the frame sees along the straightedge
  double middle_ = 0;     // of that, along x
};

Draw::Draw(std::uint64_t seed, double megapixels) : random_(seed, 100) {
  CameraModel& camera = scene_.camera;
  camera.width_px = static_cast<int>(std::lround(std::sqrt(megapixels * 1e6 * 4 / 3) / 8)) * 8;
  camera.height_px = camera.width_px / 4 * 3;
  const double light = random_.uniform();
  notes_.light = light < 1 / 3.0 ? LightNote::angles : light < 2 / 3.0 ? LightNote::post : LightNote::sun;
  notes_.markers = chance(0.5);
  notes_.calibrated = !chance(1 / 6.0);
  notes_.height = chance(0.5);
  notes_.wind = chance(0.5);
  notes_.line = chance(0.25);
  rational_ = chance(1 / 3.0);
  upright_ = chance(0.1);
  scene_.seed = seed;
}

void Draw::draw_scale_and_light() {
  pixels_per_metre_ = 1000 * log_uniform(4, 24);
  reach_ = (upright_ ? scene_.camera.height_px : scene_.camera.width_px) / pixels_per_metre_ / 2;
  scene_.elevation = uniform(15, 55) * degree;
  if (notes_.light == LightNote::sun) {
    sun_ = random_sun(&random_);
    scene_.elevation = sun_.elevation;
  }
}

void Draw::draw_appearance() {
  scene_.skylight = uniform(0.1, 0.25);
  scene_.uneven_light = uniform(0, 0.25);
  scene_.grain_diameter = 1e-3 * log_uniform(0.15, 1);
  scene_.albedo_contrast = uniform(0.1, 0.25);
  scene_.roughness = uniform(0.1, 0.3);
  scene_.blur_px = uniform(0.5, 0.9);
  scene_.blur_border_px = scene_.blur_px + uniform(0.1, 0.8);
  scene_.vignetting = uniform(0.1, 0.4);
  scene_.exposure = uniform(0.4, 0.7);
  scene_.noise = uniform(0.004, 0.015);
  scene_.jpeg_quality = static_cast<int>(uniform(85, 98));
}

void Draw::draw_lens() {
  CameraModel& camera = scene_.camera;
  camera.fx = uniform(0.7, 1.4) * camera.width_px;
  camera.cx = (camera.width_px - 1) / 2.0;
  camera.cy = (camera.height_px - 1) / 2.0;
  camera.distortion = {};
  camera.fy = camera.fx;
  if (!notes_.calibrated) return;
  camera.fy *= 1 + 0.002 * random_.normal();
  camera.cx += 0.005 * camera.width_px * random_.normal();
  camera.cy += 0.005 * camera.width_px * random_.normal();
  auto& k = camera.distortion;
  k = {uniform(-0.15, 0.15), uniform(-0.05, 0.05), uniform(-1e-3, 1e-3), uniform(-1e-3, 1e-3), 0, 0, 0, 0};
  if (!rational_) return;
  // The same kind of bending, written as the quotient that such calibrations give.
  const double k4 = uniform(-0.3, 0.3);
  const double k5 = uniform(-0.05, 0.05);
  k[0] += k4;
  k[1] += k5;
  k[4] = uniform(-0.01, 0.01);
  k[5] = k4;
  k[6] = k5;
  k[7] = uniform(-0.01, 0.01);
}

void Draw::draw_straightedge() {
  scene_.inclination = std::round(uniform(-5, 5) / 0.05) * 0.05 * degree;
  scene_.shadow_side = chance(0.5) ? 1 : -1;
  scene_.width = std::round(uniform(25, 40)) * 1e-3;
  scene_.thickness = uniform(1, 4) * 1e-3;
  scene_.azimuth = uniform(-25, 25) * degree;
  middle_ = uniform(-0.8, 0.8) * reach_;
  scene_.from = middle_ - reach_ * (chance(0.5) ? uniform(1.1, 1.3) : uniform(0.8, 0.9));
  scene_.to = middle_ + reach_ * (chance(0.5) ? uniform(1.1, 1.3) : uniform(0.8, 0.9));
}

bool Draw::draw_bed() {
  ripples_ = RippleBed{};
  const double longest = std::min(0.2, 2 * reach_ / 2.6);
  if (longest <= 0.03) return false;
  // A post's shadow must fall on a bed that is level along the crests, so these are set up with more care.
  const bool post = notes_.light == LightNote::post;
  ripples_.crest_angle = (post ? uniform(-2, 2) : uniform(-10, 10)) * degree;
  ripples_.wavelength = log_uniform(0.03, longest) * std::cos(ripples_.crest_angle);
  ripples_.relief = ripples_.wavelength / uniform(12, 25);
  ripples_.skew = uniform(0.2, 0.6);
  ripples_.phase = uniform(0, 2 * M_PI);
  ripples_.downwind = chance(0.5) ? 1 : -1;
  ripples_.slope_x = std::tan(scene_.inclination + uniform(-5, 5) * degree);
  ripples_.slope_y = std::tan((post ? uniform(-0.3, 0.3) : uniform(-3, 3)) * degree);

  const auto clearance = [this](double across) {
    double least = 1;
    for (int i = 0; i <= 300; ++i) {
      const double along = scene_.from + (scene_.to - scene_.from) * i / 300;
      const double x = along * std::cos(scene_.inclination);
      least = std::min(least, along * std::sin(scene_.inclination) - ripples_(x, across));
    }
    return least;
  };
  const double over_crests = 1e-3 * uniform(2, 15);
  ripples_.height = clearance(0) - over_crests;
  const double back = -scene_.shadow_side * scene_.width;
  if (std::min({clearance(0), clearance(back / 2), clearance(back)}) < scene_.thickness + 3e-4) return false;
  scene_.bed = ripples_;
  const auto [least, most] = facet_light(scene_, middle_, 1.5 * reach_);
  scene_.exposure = std::min(scene_.exposure, 0.9 / (most * (1 + scene_.uneven_light / 2)));
  return least > 0.35;
}

bool Draw::draw_camera() {
  double farthest = 0;
  for (int i = 0; i <= 40; ++i) {
    const double x = middle_ + (i / 20.0 - 1) * reach_;
    farthest = std::max(farthest, std::abs(true_bed_point(scene_, x).y()));
  }
  const double room = (upright_ ? scene_.camera.width_px : scene_.camera.height_px) / pixels_per_metre_;
  if (scene_.width + farthest > 0.92 * room) return false;
  const Lens lens(scene_.camera);
  if (lens.least_slope() < 0.4) return false;

  const double roll = uniform(-6, 6) * degree + (upright_ ? M_PI / 2 : 0) + (chance(0.5) ? M_PI : 0);
  const Eigen::AngleAxisd tilt_x(uniform(-20, 20) * degree, Eigen::Vector3d::UnitX());
  const Eigen::AngleAxisd tilt_y(uniform(-20, 20) * degree, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd half_turn(M_PI, Eigen::Vector3d::UnitX());  // looking down
  const Eigen::Matrix3d turn =
      (tilt_x * tilt_y * Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitZ()) * half_turn).toRotationMatrix();
  const double spare = (0.92 * room - scene_.width - farthest) / 2;
  const double across = (farthest - scene_.width) / 2 + uniform(-0.7, 0.7) * spare;
  const Eigen::Vector3d target{middle_ * std::cos(scene_.inclination), scene_.shadow_side * across,
                               middle_ * std::sin(scene_.inclination)};
  scene_.level_to_camera.linear() = turn;
  scene_.level_to_camera.translation() =
      Eigen::Vector3d(0, 0, scene_.camera.fx / pixels_per_metre_) - turn * target;

  for (const double x : {0.0, 1.0}) {
    for (const double y : {0.0, 1.0}) {
      const Eigen::Vector2d corner{x * scene_.camera.width_px, y * scene_.camera.height_px};
      const Eigen::Vector3d ray = (turn.transpose() * lens.direction(corner).homogeneous()).normalized();
      if (ray.z() > -std::cos(66 * degree)) return false;
    }
  }
  if (!notes_.calibrated && !scene_.exif_focal_px) {
    // Without a focal length from anywhere, only a clear tilt lets the marks tell it.
    if (-turn(2, 2) > std::cos(12 * degree)) return false;
  }
  layout_ = lay_out(scene_, middle_, 1.4 * reach_, 0.006 * scene_.camera.width_px);
  const double grain_px = scene_.grain_diameter * pixels_per_metre_;
  return layout_.to - layout_.from > std::max(2.1 * ripples_.wavelength, 1.1 * reach_) &&
         layout_.least_gap_px > std::max(10.0, 3 * grain_px) && layout_.least_crossing > 0.25 &&
         layout_.least_view > 0.3;
}

bool Draw::place_post() {
  if (notes_.light != LightNote::post) return true;
  scene_.post_height = std::round(uniform(20, 60)) * 1e-3;
  scene_.post_x = uniform(layout_.from, layout_.to);
  const Eigen::Matrix3d to_level = level_to_straightedge(scene_).transpose();
  const Eigen::Vector3d top = to_level * Eigen::Vector3d(scene_.post_x, 0, *scene_.post_height);
  if ((scene_.level_to_camera * top).z() < 0.02) return false;
  const Eigen::Vector3d tip_shadow = scene_.level_to_camera * true_tip_shadow(scene_);
  const Eigen::Vector2d tip = Lens(scene_.camera).pixel(tip_shadow.hnormalized());
  // A direction far outside the frame may be folded back into it by the polynomial of the lens.
  if (!in_frame(scene_.camera, tip, 20) ||
      (Lens(scene_.camera).direction(tip) - tip_shadow.hnormalized()).norm() > 1e-6)
    return false;
  const Eigen::Vector2d seen_top = true_pixel(scene_, top);
  const Eigen::Vector2d foot = true_pixel(scene_, to_level * Eigen::Vector3d(scene_.post_x, 0, 0));
  const double t = std::clamp((tip - foot).dot(seen_top - foot) / (seen_top - foot).squaredNorm(), 0.0, 1.0);
  return in_frame(scene_.camera, foot, 20) && (tip - foot - t * (seen_top - foot)).norm() > 30;
}

double Draw::wavelength_along_section() const {
  constexpr int stations = 400;
  double covariance = 0;
  double variance = 0;
  const double middle = (layout_.from + layout_.to) / 2;
  for (int i = 0; i <= stations; ++i) {
    const double x = layout_.from + (layout_.to - layout_.from) * i / stations;
    const Eigen::Vector3d point = true_bed_point(scene_, x);
    covariance += (x - middle) * ripples_.phase_at(point.x(), point.y());
    variance += (x - middle) * (x - middle);
  }
  return 2 * M_PI * variance / covariance;
}

SetUp Draw::set_up() {
  draw_appearance();
  const double exposure = scene_.exposure;
  const bool exif = !notes_.calibrated && chance(2 / 3.0);
  constexpr int attempts = 100000;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    // Scale and light stay for many attempts, so that the hard ones are not just replaced by easy ones.
    if (attempt % 300 == 0) draw_scale_and_light();
    scene_.exposure = exposure;
    draw_lens();
    if (exif) scene_.exif_focal_px = scene_.camera.fx * (1 + 0.01 * random_.normal());
    draw_straightedge();
    if (!draw_bed() || !draw_camera() || !place_post()) continue;
    mark_straightedge(&scene_, notes_.markers, layout_.from, layout_.to);
    SetUp set_up;
    set_up.scene = scene_;
    set_up.setup = take_notes(scene_, layout_, notes_, sun_, ripples_.downwind, &random_);
    set_up.yaml = setup_yaml(set_up.setup);
    set_up.wavelength = wavelength_along_section();
    set_up.from = layout_.from;
    set_up.to = layout_.to;
    return set_up;
  }
  throw Error("set-up: nothing fits the frame");
}

}  // namespace

SetUp random_set_up(std::uint64_t seed, double megapixels) { return Draw(seed, megapixels).set_up(); }

}  // namespace aeolian
