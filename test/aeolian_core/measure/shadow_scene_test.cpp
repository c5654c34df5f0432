#include "../../rendering/shadow_scene.hpp"

#include <cmath>

#include "../../rendering/almanac.hpp"
#include "../../rendering/lens.hpp"
#include <gtest/gtest.h>
#include <opencv2/aruco.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

double linear(double srgb) {
  const double v = srgb / 255;
  return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

/// A photograph as linear light, to be looked at between the pixels.
class LinearPhoto {
 public:
  explicit LinearPhoto(const Photo& photo) : width_(photo.width_px) {
    for (const std::uint8_t value : photo.values8) values_.push_back(linear(value));
  }
  double at(const Eigen::Vector2d& p) const {
    const int x = static_cast<int>(std::floor(p.x()));
    const int y = static_cast<int>(std::floor(p.y()));
    const double u = p.x() - x;
    const double v = p.y() - y;
    return (1 - v) * ((1 - u) * value(x, y) + u * value(x + 1, y)) +
           v * ((1 - u) * value(x, y + 1) + u * value(x + 1, y + 1));
  }
  /// Where the light along start + t * step passes a level, between t = 0 and 1.
  double crossing(const Eigen::Vector2d& start, const Eigen::Vector2d& step, double level) const {
    constexpr int parts = 400;
    double before = at(start);
    for (int i = 1; i <= parts; ++i) {
      const double after = at(start + step * i / parts);
      if ((before < level) != (after < level)) return (i - 1 + (level - before) / (after - before)) / parts;
      before = after;
    }
    return NAN;
  }

 private:
  double value(int x, int y) const { return values_.at(static_cast<std::size_t>(y * width_ + x)); }

  int width_;
  std::vector<double> values_;
};

/// A camera over the casting edge, its rows along it, seeing `pixels_per_metre` at the height of the edge.
void look_down(ShadowScene* scene, double pixels_per_metre, double tilt_x, double tilt_y) {
  scene->camera.width_px = 1000;
  scene->camera.height_px = 750;
  scene->camera.fx = scene->camera.fy = 1100;
  scene->camera.cx = 499.5;
  scene->camera.cy = 374.5;
  scene->level_to_camera.linear() = (Eigen::AngleAxisd(tilt_x, Eigen::Vector3d::UnitX()) *
                                     Eigen::AngleAxisd(tilt_y, Eigen::Vector3d::UnitY()) *
                                     Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitX()))
                                        .toRotationMatrix();
  scene->level_to_camera.translation() = Eigen::Vector3d(0, 0, 1100 / pixels_per_metre);
}

/// A level bed without grains under a straightedge, drawn without noise.
ShadowScene plain_scene(double depth) {
  ShadowScene scene;
  scene.bed = [depth](double, double) { return -depth; };
  scene.uneven_light = scene.vignetting = scene.noise = 0;
  scene.albedo_contrast = scene.roughness = 0;
  scene.jpeg_quality = 0;
  scene.exposure = 0.6;
  scene.blur_px = scene.blur_border_px = 1.5;  // smooth enough to look between the pixels
  look_down(&scene, 10000, 0, 0);
  return scene;
}

/// Mean and largest distance [px] of the drawn far border from the true one, at stations along it.
struct Offset {
  double mean = 0;
  double most = 0;
};
Offset border_offset(const ShadowScene& scene, double from, double to, double half_step_px) {
  const LinearPhoto photo(photograph(scene));
  constexpr int stations = 150;
  Offset offset;
  for (int i = 0; i < stations; ++i) {
    const double x = from + (to - from) * (i + 0.5) / stations;
    const Eigen::Vector2d here = true_pixel(scene, true_bed_point(scene, x));
    const Eigen::Vector2d along = true_pixel(scene, true_bed_point(scene, x + 1e-5)) - here;
    const Eigen::Vector3d beyond = true_bed_point(scene, x) + Eigen::Vector3d(0, scene.shadow_side * 1e-5, 0);
    Eigen::Vector2d outwards{-along.y(), along.x()};
    if (outwards.dot(true_pixel(scene, beyond) - here) < 0) outwards = -outwards;
    outwards.normalize();
    const Eigen::Vector2d start = here - half_step_px * outwards;
    const double level = (photo.at(start) + photo.at(here + half_step_px * outwards)) / 2;
    const double t = photo.crossing(start, 2 * half_step_px * outwards, level);
    const double distance = (2 * t - 1) * half_step_px;
    offset.mean += distance / stations;
    offset.most = std::isnan(distance) ? 1e9 : std::max(offset.most, std::abs(distance));
  }
  return offset;
}

TEST(ShadowScene, DrawsTheFarBorderWhereTheGeometrySaysItIs) {
  struct Pose {
    double elevation, azimuth, inclination, tilt_x, tilt_y;
    int side;
    bool lens;
  };
  for (const Pose& pose : {Pose{35, 0, 0, 0, 0, 1, false}, Pose{20, 20, 2, 10, -8, 1, true},
                           Pose{50, -25, -4, -8, 15, 1, true}, Pose{30, 12, 3, 12, 5, -1, true}}) {
    ShadowScene scene = plain_scene(0.008);
    look_down(&scene, 9000, pose.tilt_x * degree, pose.tilt_y * degree);
    if (pose.lens) scene.camera.distortion = {-0.12, 0.04, 0.0008, -0.0006, 0, 0.05, 0.01, 0};
    scene.sun_diameter = 1e-6;
    scene.elevation = pose.elevation * degree;
    scene.azimuth = pose.azimuth * degree;
    scene.inclination = pose.inclination * degree;
    scene.shadow_side = pose.side;
    const Offset offset = border_offset(scene, -0.035, 0.035, 6);
    EXPECT_LT(std::abs(offset.mean), 0.02) << pose.elevation;
    EXPECT_LT(offset.most, 0.05) << pose.elevation;
  }
}

TEST(ShadowScene, TrueBedPointOfALevelBedIsAnalytic) {
  // Werner's general orthographic relation, section 2.2 of the specification.
  ShadowScene scene = plain_scene(0.02);
  scene.elevation = 0.5;
  scene.azimuth = 0.3;
  scene.inclination = 0.06;
  const Eigen::Vector3d point = true_bed_point(scene, 0.1);
  const double slope = std::tan(0.5) / std::cos(0.3) + std::tan(0.06) * std::tan(0.3);
  EXPECT_NEAR(point.z(), point.x() * std::tan(0.06) - point.y() * slope, 1e-12);
  EXPECT_NEAR(point.z(), -0.02, 1e-12);
  EXPECT_NEAR(point.x() * std::cos(0.06) + point.z() * std::sin(0.06), 0.1, 1e-12);
}

TEST(ShadowScene, PenumbraHasTheWidthOfTheSun) {
  // Level ground a drop zeta below the edge: zeta * diameter / sin^2(elevation) from dark to bright.
  const double drop = 0.03;
  ShadowScene scene = plain_scene(drop);
  look_down(&scene, 8000, 0, 0);
  scene.sun_diameter = 0.03;
  scene.elevation = 40 * degree;
  scene.blur_px = scene.blur_border_px = 0;
  const LinearPhoto photo(photograph(scene));
  const double pixels_per_metre = 1100 / (1100 / 8000.0 + drop);
  const double width_px =
      drop * scene.sun_diameter / std::pow(std::sin(scene.elevation), 2) * pixels_per_metre;
  const Eigen::Vector2d border = true_pixel(scene, true_bed_point(scene, 0.01));
  const Eigen::Vector2d start = border + Eigen::Vector2d(0, width_px);
  const Eigen::Vector2d step{0, -2 * width_px};
  const double dark = photo.at(start);
  const double bright = photo.at(start + step);
  // A chord half way from the middle to the rim of a disc cuts off 19.55 % of it.
  const double low = photo.crossing(start, step, dark + 0.1955 * (bright - dark));
  const double high = photo.crossing(start, step, dark + 0.8045 * (bright - dark));
  EXPECT_NEAR((high - low) * 2 * width_px, width_px / 2, 0.03 * width_px);
  EXPECT_NEAR((high + low) / 2, 0.5, 0.02);
}

TEST(ShadowScene, LightPassesUnderTheStraightedge) {
  ShadowScene scene = plain_scene(0.04);
  scene.width = 0.02;
  scene.thickness = 0.004;
  scene.elevation = 35 * degree;
  scene.sun_diameter = 1e-6;
  look_down(&scene, 6000, 0, 0);
  const LinearPhoto photo(photograph(scene));
  // Its lower edge on the light's side casts the near border.
  const double y = -0.02 + (0.04 - 0.004) / std::tan(scene.elevation);
  const Eigen::Vector2d border = true_pixel(scene, {0.01, y, -0.04});
  const Eigen::Vector2d start = border + Eigen::Vector2d(0, 6);
  const double level = (photo.at(start) + photo.at(start - Eigen::Vector2d(0, 12))) / 2;
  EXPECT_GT(photo.at(start), 2 * photo.at(start - Eigen::Vector2d(0, 12)));
  EXPECT_NEAR(12 * photo.crossing(start, {0, -12}, level), 6, 0.05);
}

TEST(ShadowScene, PostEndsItsShadowAtTheTip) {
  ShadowScene scene = plain_scene(0.006);
  scene.post_height = 0.02;
  scene.post_x = 0.004;
  scene.elevation = 35 * degree;
  scene.azimuth = 15 * degree;
  scene.inclination = 2 * degree;
  scene.sun_diameter = 0.003;
  const LinearPhoto photo(photograph(scene));
  const Eigen::Vector2d tip = true_pixel(scene, true_tip_shadow(scene));
  ShadowScene without_height = scene;
  without_height.post_height = 0;
  const Eigen::Vector2d foot = true_pixel(scene, true_tip_shadow(without_height));
  const Eigen::Vector2d back = (foot - tip).normalized();
  const Eigen::Vector2d start = tip + 5 * back;
  const double level = (photo.at(start) + photo.at(tip - 5 * back)) / 2;
  EXPECT_LT(photo.at(start), 0.6 * photo.at(tip - 5 * back));
  EXPECT_NEAR(10 * photo.crossing(start, -10 * back, level), 5, 0.5);
}

TEST(ShadowScene, MarkersAreWhereTheyAreSaidToBe) {
  ShadowScene scene = plain_scene(0.008);
  look_down(&scene, 9000, 8 * degree, -10 * degree);
  scene.camera.distortion = {-0.1, 0.03, 0.0005, 0.0003, 0, 0, 0, 0};
  scene.inclination = 2 * degree;
  scene.shadow_side = -1;
  scene.exposure = 0.5;
  PhotoSetup::Markers markers;
  markers.dictionary = "DICT_4X4_50";
  markers.size = 0.012;
  for (int i = 0; i < 5; ++i) markers.centres.push_back({i + 3, {-0.036 + 0.018 * i, 0.015}});
  scene.markers = markers;
  Photo photo = photograph(scene);
  const cv::Mat picture(photo.height_px, photo.width_px, CV_8U, photo.values8.data());
  std::vector<std::vector<cv::Point2f>> corners;
  std::vector<int> ids;
  cv::aruco::detectMarkers(picture, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50), corners, ids);
  ASSERT_EQ(ids.size(), 5U);
  const LinearPhoto light(photo);
  const Eigen::AngleAxisd to_level(-scene.inclination, Eigen::Vector3d::UnitY());
  const auto face_pixel = [&](const Eigen::Vector2d& p) {
    return true_pixel(scene, to_level * Eigen::Vector3d(p.x(), p.y(), 0));
  };
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const Eigen::Vector2d centre = markers.centres[static_cast<std::size_t>(ids[i] - 3)].position;
    const Eigen::Vector2d order[4] = {{-1, 1}, {1, 1}, {1, -1}, {-1, -1}};  // upper left first, clockwise
    for (std::size_t k = 0; k < 4; ++k) {
      const Eigen::Vector2d corner = face_pixel(centre + 0.006 * order[k]);
      EXPECT_NEAR(corners[i][k].x, corner.x(), 2.5) << ids[i];
      EXPECT_NEAR(corners[i][k].y, corner.y(), 2.5) << ids[i];
      // The side after the corner, where half the light is reached; a corner itself is rounded by the blur.
      const Eigen::Vector2d side = (order[k] + order[(k + 1) % 4]) / 2;
      const Eigen::Vector2d pixel = face_pixel(centre + 0.006 * side);
      const Eigen::Vector2d out = (face_pixel(centre + 0.0061 * side) - pixel).normalized();
      const double level = (light.at(pixel - 4 * out) + light.at(pixel + 4 * out)) / 2;
      EXPECT_NEAR(8 * light.crossing(pixel - 4 * out, 8 * out, level), 4, 0.1) << ids[i] << " " << k;
    }
  }
}

TEST(ShadowScene, GrainsLeaveTheBorderUnbiased) {
  ShadowScene scene = plain_scene(0.008);
  scene.albedo_contrast = 0.15;
  scene.roughness = 0.25;
  scene.grain_diameter = 0.00025;  // 2.3 px, 0.57 px rms as height
  scene.elevation = 40 * degree;
  double mean = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4}) {
    scene.seed = seed;
    // Averaged along the rows, which run along the border.
    Photo photo = photograph(scene);
    cv::Mat picture(photo.height_px, photo.width_px, CV_8U, photo.values8.data());
    std::vector<double> light;
    for (int row = 0; row < photo.height_px; ++row) {
      double sum = 0;
      for (int column = 50; column < 950; ++column) sum += linear(picture.at<std::uint8_t>(row, column));
      light.push_back(sum / 900);
    }
    const double border = true_pixel(scene, true_bed_point(scene, 0)).y();
    const auto row = static_cast<std::size_t>(border);
    const double bright = light[row - 12];
    const double dark = light[row + 12];
    double area = 0;  // as far as the bright side reaches down
    for (std::size_t i = row - 12; i <= row + 12; ++i) area += (light[i] - dark) / (bright - dark);
    mean += (static_cast<double>(row) - 12.5 + area - border) / 4;
  }
  EXPECT_NEAR(mean, 0, 0.12);
}

TEST(ShadowScene, IsTheSameOnAnyNumberOfThreads) {
  const ShadowScene scene = random_set_up(7, 0.3).scene;
  const int before = cv::getNumThreads();
  cv::setNumThreads(1);
  const Photo one = photograph(scene);
  cv::setNumThreads(2);
  const Photo two = photograph(scene);
  cv::setNumThreads(before);
  EXPECT_EQ(one.values8, two.values8);
}

TEST(SceneLens, AgreesWithOpenCv) {
  CameraModel camera;
  camera.width_px = 2000;
  camera.height_px = 1500;
  camera.fx = 1500;
  camera.fy = 1505;
  camera.cx = 990;
  camera.cy = 760;
  camera.distortion = {0.1, -0.04, 0.001, -0.0007, 0.01, 0.2, -0.03, 0.005};
  const Lens lens(camera);
  const cv::Matx33d matrix(1500, 0, 990, 0, 1505, 760, 0, 0, 1);
  const std::vector<double> distortion{0.1, -0.04, 0.001, -0.0007, 0.01, 0.2, -0.03, 0.005};
  for (const double y : {0.0, 333.0, 1499.0}) {
    const std::vector<Eigen::Vector2d> row = lens.row(y);
    for (int x = -1; x <= 2000; x += 23) {
      const Eigen::Vector2d d = row[static_cast<std::size_t>(x + 1)];
      std::vector<cv::Point2d> seen;
      cv::projectPoints(std::vector<cv::Point3d>{{d.x(), d.y(), 1}}, cv::Vec3d(), cv::Vec3d(), matrix,
                        distortion, seen);
      EXPECT_NEAR(seen[0].x, x, 1e-6);
      EXPECT_NEAR(seen[0].y, y, 1e-6);
    }
  }
}

TEST(AlmanacSun, AgreesWithThePublishedExample) {
  // Reda and Andreas (2004), table A4: Golden, Colorado, 2003-10-17 19:30:30 UTC; at 820 hPa.
  const AlmanacSun sun = almanac_sun(1066419030, 39.742476 * degree, -105.1786 * degree);
  EXPECT_NEAR(sun.elevation / degree, 90 - 50.11162, 0.012);
  EXPECT_NEAR(std::fmod(sun.azimuth / degree + 360, 360), 194.34024, 0.012);
}

TEST(RandomSetUp, KeepsWhatItPromises) {
  int markers = 0;
  int lights[4] = {};
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    const auto set_up = random_set_up(seed, 3);
    const ShadowScene& scene = set_up.scene;
    EXPECT_GT(scene.elevation, 14.99 * degree);
    EXPECT_LT(scene.elevation, 55.01 * degree);
    EXPECT_GE(set_up.to - set_up.from, 2 * set_up.wavelength) << seed;
    for (int i = 0; i <= 20; ++i) {
      const double x = set_up.from + (set_up.to - set_up.from) * i / 20;
      const Eigen::Vector2d pixel = true_pixel(scene, true_bed_point(scene, x));
      EXPECT_GT(pixel.minCoeff(), 5);
      EXPECT_LT(pixel.x(), scene.camera.width_px - 5);
      EXPECT_LT(pixel.y(), scene.camera.height_px - 5);
    }
    ++lights[set_up.setup.light.index()];
    markers += set_up.setup.markers ? 1 : 0;
    EXPECT_TRUE(set_up.setup.markers || set_up.setup.scale.size() >= 20) << seed;
    const YAML::Node yaml = YAML::Load(set_up.yaml);
    EXPECT_NEAR(yaml["grain_diameter_mm"].as<double>(), 1e3 * *set_up.setup.grain_diameter, 1e-6);
    EXPECT_EQ(static_cast<bool>(yaml["camera"]), set_up.setup.camera.has_value());
    EXPECT_NEAR(yaml["straightedge"]["inclination_deg"].as<double>() * degree, scene.inclination, 1e-9);
  }
  EXPECT_GT(markers, 10);
  EXPECT_LT(markers, 30);
  for (int i = 1; i < 4; ++i) EXPECT_GT(lights[i], 5) << i;
}

TEST(RandomSetUp, ShowsTheTrueBorderOnItsPhoto) {
  for (const std::uint64_t seed : {1, 4, 8}) {
    auto set_up = random_set_up(seed, 0.8);
    ShadowScene& scene = set_up.scene;
    scene.albedo_contrast = scene.roughness = scene.noise = 0;
    scene.vignetting = scene.uneven_light = 0;
    scene.jpeg_quality = 0;
    scene.sun_diameter = 1e-6;
    scene.post_height.reset();
    const double inset = 0.05 * (set_up.to - set_up.from);
    const Offset offset = border_offset(scene, set_up.from + inset, set_up.to - inset, 4);
    EXPECT_LT(std::abs(offset.mean), 0.03) << seed;
    EXPECT_LT(offset.most, 0.15) << seed;
  }
}

}  // namespace
}  // namespace aeolian
