#include "unmeasurable.hpp"

#include <algorithm>
#include <cmath>

#include "grain_texture.hpp"
#include "image_formation.hpp"
#include <opencv2/imgproc.hpp>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {

namespace {

constexpr double megapixels = 1;

using Spoil = std::function<void(cv::Mat*)>;

std::function<void(Photo*)> on_picture(const Spoil& spoil) {
  return [spoil](Photo* photo) {
    cv::Mat picture(photo->height_px, photo->width_px, CV_8U, photo->values8.data());
    cv::Mat spoilt = picture.clone();
    spoil(&spoilt);
    spoilt.copyTo(picture);
  };
}

void scale_light(cv::Mat* picture, double factor) {
  cv::Mat table(1, 256, CV_8U);
  for (int v = 0; v < 256; ++v) {
    table.at<std::uint8_t>(v) =
        cv::saturate_cast<std::uint8_t>(255 * std::pow(factor * std::pow(v / 255.0, 2.2), 1 / 2.2));
  }
  cv::LUT(picture->clone(), table, *picture);
}

void shake(cv::Mat* picture, int length, double angle) {
  cv::Mat kernel = cv::Mat::zeros(length, length, CV_32F);
  const cv::Point2d middle(length / 2.0, length / 2.0);
  const cv::Point2d half(std::cos(angle) * length / 2, std::sin(angle) * length / 2);
  cv::line(kernel, middle - half, middle + half, 1);
  cv::filter2D(picture->clone(), *picture, -1, kernel / cv::sum(kernel)[0], {-1, -1}, 0,
               cv::BORDER_REPLICATE);
}

/// Takes the direct light away inside a soft-edged outline, as the shadow of something out of frame does.
void shade(cv::Mat* picture, const ShadowScene& scene, const std::vector<cv::Point>& outline) {
  ShadowScene shaded = scene;
  shaded.skylight = 0.999;
  shaded.exposure *= scene.skylight;
  Photo dark = photograph(shaded);
  const cv::Mat without_sun(dark.height_px, dark.width_px, CV_8U, dark.values8.data());
  cv::Mat mask = cv::Mat::zeros(picture->size(), CV_32F);
  cv::fillPoly(mask, std::vector<std::vector<cv::Point>>{outline}, 1);
  cv::GaussianBlur(mask, mask, {}, 6);
  cv::blendLinear(without_sun, picture->clone(), mask, 1 - mask, *picture);
}

cv::Point seen(const ShadowScene& scene, const Eigen::Vector3d& point) {
  const Eigen::Vector2d pixel = true_pixel(scene, point);
  return {static_cast<int>(std::lround(pixel.x())), static_cast<int>(std::lround(pixel.y()))};
}

/// A straight-sided patch of bed along the section, from `before` to `beyond` its far border (in y, m).
std::vector<cv::Point> around_border(const SetUp& set_up, double before, double beyond) {
  const ShadowScene& scene = set_up.scene;
  const double inset = 0.02 * (set_up.to - set_up.from);
  const Eigen::Vector3d left = true_bed_point(scene, set_up.from + inset);
  const Eigen::Vector3d right = true_bed_point(scene, set_up.to - inset);
  const Eigen::Vector3d along = 0.2 * (right - left);
  const Eigen::Vector3d in{0, -scene.shadow_side * before, 0};
  const Eigen::Vector3d out{0, scene.shadow_side * beyond, 0};
  return {seen(scene, left - along + in), seen(scene, right + along + in), seen(scene, right + along + out),
          seen(scene, left - along + out)};
}

/// Moves the picture's contents so that the camera looks elsewhere: along y of the level frame [m].
void look_aside(ShadowScene* scene, double along_y) {
  scene->level_to_camera.translation() -= scene->level_to_camera.linear() * Eigen::Vector3d(0, along_y, 0);
}

/// Collects the fifty; every scene starts from another random set-up.
class Collection {
 public:
  void add(const std::string& name, const std::string& reason,
           const std::function<void(ShadowScene*)>& change, const Spoil& spoil = nullptr) {
    UnmeasurableScene scene{name, reason, random_set_up(seed_++, megapixels), nullptr};
    if (change) change(&scene.set_up.scene);
    if (spoil) scene.spoil = on_picture(spoil);
    scenes_.push_back(std::move(scene));
  }
  /// The same where what is done to the picture depends on the set-up.
  void add_spoilt(const std::string& name, const std::string& reason,
                  const std::function<Spoil(const SetUp&)>& spoil_for) {
    add(name, reason, nullptr);
    scenes_.back().spoil = on_picture(spoil_for(scenes_.back().set_up));
  }
  std::vector<UnmeasurableScene> take() { return std::move(scenes_); }

 private:
  std::uint64_t seed_ = 9000;
  std::vector<UnmeasurableScene> scenes_;
};

void add_light_faults(Collection* all) {
  for (int i = 0; i < 4; ++i) {
    all->add("overcast, no shadow", "shadow", [](ShadowScene* s) { s->skylight = 0.999; });
  }
  for (const double azimuth : {-75.0, -40.0, 40.0, 50.0}) {
    // Turned so far that neither shadow covers the other's border.
    all->add("two lights, two shadows", "two",
             [azimuth](ShadowScene* s) { s->second_light_azimuth = s->azimuth + azimuth * degree; });
  }
  for (const double factor : {8.0, 15.0, 40.0}) {
    all->add("over-exposed", "exposed", [factor](ShadowScene* s) { s->exposure *= factor; });
  }
  for (const double factor : {4e-4, 1e-3}) {
    all->add("under-exposed", "exposed", [factor](ShadowScene* s) { s->exposure *= factor; });
  }
  for (const double noise : {0.6, 1.0, 1.5}) {
    all->add("noise as strong as the contrast", "contrast", [noise](ShadowScene* s) {
      s->noise = noise;
      s->skylight = 0.7;
    });
  }
  all->add("sun behind thin cloud", "shadow", [](ShadowScene* s) { s->sun_diameter = 1.2; });
  all->add("sun behind cloud", "shadow", [](ShadowScene* s) { s->sun_diameter = 1.6; });
  all->add("flat white snow", "exposed", [](ShadowScene* s) {
    s->albedo = 0.9;
    s->albedo_contrast = 0.01;
    s->skylight = 0.95;
    s->exposure = 1.4;
  });
}

void add_camera_faults(Collection* all) {
  for (const double along : {-0.6, 0.6, 1.0}) {
    all->add("straightedge outside the frame", "frame", [along](ShadowScene* s) {
      look_aside(s, along * s->level_to_camera.inverse().translation().z());
    });
  }
  for (const double along : {1.6}) {
    all->add("bare bed", "frame", [along](ShadowScene* s) {
      look_aside(s, along * s->level_to_camera.inverse().translation().z());
    });
  }
  for (int i = 0; i < 4; ++i) {
    all->add("far border outside the frame", "frame", [](ShadowScene* s) {
      // Aimed at the light's side: the straightedge stays, the shadow leaves the frame.
      const double height =
          s->camera.height_px / s->camera.fx * s->level_to_camera.inverse().translation().z();
      const double sink = 1.5 * height * std::tan(s->elevation);
      const auto bed = s->bed;
      s->bed = [bed, sink](double x, double y) { return bed(x, y) - sink; };
    });
  }
  for (const double sigma : {10.0, 14.0, 20.0}) {
    all->add("out of focus", "blur", [sigma](ShadowScene* s) { s->blur_px = s->blur_border_px = sigma; });
  }
  for (const double angle : {0.4, 1.3, 2.2}) {
    all->add("shaken", "blur", nullptr, [angle](cv::Mat* picture) { shake(picture, 41, angle); });
  }
  for (const int quality : {1, 2}) {
    all->add(
        "thumbnail blown up, JPEG quality " + std::to_string(quality), "blur",
        [quality](ShadowScene* s) { s->jpeg_quality = quality; },
        [quality](cv::Mat* picture) {
          cv::Mat small;
          cv::resize(*picture, small, {}, 0.06, 0.06, cv::INTER_AREA);
          cv::resize(through_jpeg(small, 20 * quality), *picture, picture->size(), 0, 0, cv::INTER_CUBIC);
        });
  }
}

void add_scene_faults(Collection* all) {
  for (int i = 0; i < 4; ++i) {
    all->add_spoilt("a person's shadow over the border", "shadow", [](const SetUp& set_up) -> Spoil {
      const std::vector<cv::Point> outline = around_border(set_up, 0.025, 0.025);
      return [outline, scene = set_up.scene](cv::Mat* picture) { shade(picture, scene, outline); };
    });
  }
  for (int i = 0; i < 3; ++i) {
    all->add_spoilt("border on a dark thing", "shadow", [](const SetUp& set_up) -> Spoil {
      const std::vector<cv::Point> outline = around_border(set_up, 0.008, 0.012);
      return [outline](cv::Mat* picture) {
        cv::fillPoly(*picture, std::vector<std::vector<cv::Point>>{outline}, 25);
      };
    });
  }
  for (int i = 0; i < 2; ++i) {
    all->add("a hand over the picture", "shadow", nullptr, [i](cv::Mat* picture) {
      const cv::Rect most(i * picture->cols / 10, 0, picture->cols * 9 / 10, picture->rows);
      (*picture)(most) = 120;
      cv::Mat hand = (*picture)(most);
      cv::GaussianBlur(hand, hand, {}, 3);
    });
  }
}

void add_empty_pictures(Collection* all) {
  all->add("black", "exposed", nullptr, [](cv::Mat* picture) { *picture = 0; });
  all->add("white", "exposed", nullptr, [](cv::Mat* picture) { *picture = 255; });
  all->add("uniform grey", "contrast", nullptr, [](cv::Mat* picture) { *picture = 128; });
  all->add("only noise", "contrast", nullptr, [](cv::Mat* picture) {
    std::uint64_t pixel = 0;
    for (auto value = picture->begin<std::uint8_t>(); value != picture->end<std::uint8_t>(); ++value) {
      *value = cv::saturate_cast<std::uint8_t>(128 + 40 * GrainTexture::normal(GrainTexture::mix(++pixel)));
    }
  });
  all->add("lens cap half on", "exposed", nullptr, [](cv::Mat* picture) { scale_light(picture, 2e-4); });
  all->add("sand without a straightedge", "frame", [](ShadowScene* s) {
    s->from = 40;
    s->to = 41;
  });
}

}  // namespace

Photo UnmeasurableScene::photo() const {
  Photo photo = photograph(set_up.scene);
  if (spoil) spoil(&photo);
  return photo;
}

std::vector<UnmeasurableScene> unmeasurable_set_ups() {
  Collection all;
  add_light_faults(&all);
  add_camera_faults(&all);
  add_scene_faults(&all);
  add_empty_pictures(&all);
  return all.take();
}

}  // namespace aeolian
