#include "aeolian_core/measure/photo_setup.hpp"

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>

#include "aeolian_core/surface/degree.hpp"

namespace aeolian {
namespace {

const std::string scale = "straightedge: {scale_px_mm: [[100, 50, 0], [300, 52, 20], [500, 54, 40]]}\n";
const std::string light = "light: {elevation_deg: 35, azimuth_deg: -5}\n";
const std::string camera_keys = "image_width: 4000, image_height: 3000, camera_matrix: ";
const std::string matrix = "[3500, 0, 2000, 0, 3510, 1490, 0, 0, 1]";

class PhotoSetupFile : public testing::Test {
 protected:
  PhotoSetup read(const std::string& text) const {
    return read_photo_setup(folder_.write("setup.yaml", text));
  }
  /// Expects one line: the file, then `rest`.
  void expect_refusal(const std::string& text, const std::string& rest) const {
    EXPECT_EQ(error_of([&] { read(text); }), folder_.file("setup.yaml") + rest) << text;
  }
  const TemporaryFolder folder_;
};

TEST_F(PhotoSetupFile, EveryKey) {
  const PhotoSetup setup = read(R"(
camera:
  image_width: 4000
  image_height: 3000
  camera_matrix: [3500, 0, 2000, 0, 3510, 1490, 0, 0, 1]
  distortion_model: plumb_bob
  distortion_coefficients: [-0.1, 0.02, 0.001, -0.002, 0.003]
  plumb: true
straightedge:
  line_px: [[10, 20], [3000, 25.5]]
  scale_px_mm: [[100, 50, 0], [300, 52, 20, -10], [500, 54, 40, -10]]
  markers: {dictionary: DICT_4X4_50, size_mm: 20, centres_mm: [[3, 15, -15], [4, 45.5, -15]]}
  inclination_deg: -2.5
  height_mm: 60
light: {post: {height_mm: 40, base_px: [200, 60], tip_px: [210, 400]}}
grain_diameter_mm: 0.27
wind_px: [1, -0.5]
)");
  ASSERT_TRUE(setup.camera);
  EXPECT_EQ(setup.camera->width_px, 4000);
  EXPECT_EQ(setup.camera->height_px, 3000);
  EXPECT_EQ(setup.camera->fx, 3500);
  EXPECT_EQ(setup.camera->fy, 3510);
  EXPECT_EQ(setup.camera->cx, 2000);
  EXPECT_EQ(setup.camera->cy, 1490);
  EXPECT_EQ(setup.camera->distortion, (std::array<double, 8>{-0.1, 0.02, 0.001, -0.002, 0.003, 0, 0, 0}));
  EXPECT_TRUE(setup.plumb);
  ASSERT_EQ(setup.line_px.size(), 2U);
  EXPECT_EQ(setup.line_px[1], Eigen::Vector2d(3000, 25.5));
  ASSERT_EQ(setup.scale.size(), 3U);
  EXPECT_EQ(setup.scale[1].pixel, Eigen::Vector2d(300, 52));
  EXPECT_NEAR(setup.scale[1].x, 0.020, 1e-15);
  EXPECT_FALSE(setup.scale[0].y);
  EXPECT_NEAR(setup.scale[1].y.value(), -0.010, 1e-15);
  ASSERT_TRUE(setup.markers);
  EXPECT_EQ(setup.markers->dictionary, "DICT_4X4_50");
  EXPECT_NEAR(setup.markers->size, 0.020, 1e-15);
  ASSERT_EQ(setup.markers->centres.size(), 2U);
  EXPECT_EQ(setup.markers->centres[1].id, 4);
  EXPECT_NEAR((setup.markers->centres[1].position - Eigen::Vector2d(0.0455, -0.015)).norm(), 0, 1e-15);
  EXPECT_NEAR(setup.inclination, -2.5 * degree, 1e-15);
  EXPECT_NEAR(setup.height.value(), 0.060, 1e-15);
  const auto& post = std::get<PhotoSetup::Post>(setup.light);
  EXPECT_NEAR(post.height, 0.040, 1e-15);
  EXPECT_EQ(post.base_px, Eigen::Vector2d(200, 60));
  EXPECT_EQ(post.tip_px, Eigen::Vector2d(210, 400));
  EXPECT_NEAR(setup.grain_diameter.value(), 0.00027, 1e-15);
  EXPECT_EQ(setup.wind_px.value(), Eigen::Vector2d(1, -0.5));
}

TEST(PhotoSetupExample, CanBeRead) {
  const PhotoSetup setup = read_photo_setup(AEOLIAN_REPOSITORY "/config/measure_photo.example.yaml");
  EXPECT_TRUE(setup.camera);
  EXPECT_TRUE(setup.markers);
  EXPECT_TRUE(std::holds_alternative<PhotoSetup::Post>(setup.light));
}

TEST_F(PhotoSetupFile, TheLeastThatIsNeeded) {
  const PhotoSetup setup = read(scale + "light: {elevation_deg: 35}\n");
  EXPECT_FALSE(setup.camera);
  EXPECT_FALSE(setup.plumb);
  EXPECT_EQ(setup.scale.size(), 3U);
  EXPECT_EQ(setup.inclination, 0);
  EXPECT_FALSE(setup.height);
  EXPECT_NEAR(std::get<PhotoSetup::Angles>(setup.light).elevation, 35 * degree, 1e-15);
  EXPECT_EQ(std::get<PhotoSetup::Angles>(setup.light).azimuth, 0);
  EXPECT_TRUE(read("camera: {plumb: true}\n" + scale + light).plumb);
}

TEST_F(PhotoSetupFile, LightOfTheSun) {
  const PhotoSetup setup = read(scale +
                                "light: {sun: {utc: 2003-10-17T19:30:30Z, latitude_deg: 39.74, "
                                "longitude_deg: -105.18, north_px: [0, -1]}}");
  const auto& sun = std::get<PhotoSetup::Sun>(setup.light);
  EXPECT_EQ(sun.unix_time, 1066419030);
  EXPECT_NEAR(sun.latitude, 39.74 * degree, 1e-15);
  EXPECT_NEAR(sun.longitude, -105.18 * degree, 1e-15);
  EXPECT_EQ(sun.north_px, Eigen::Vector2d(0, -1));
}

TEST_F(PhotoSetupFile, ACalibrationAsRosWritesIt) {
  const std::string calibration = R"(image_width: 4000
image_height: 3000
camera_name: handheld
camera_matrix:
  rows: 3
  cols: 3
  data: [3500, 0, 2000, 0, 3510, 1490, 0, 0, 1]
distortion_model: rational_polynomial
distortion_coefficients: {rows: 1, cols: 8, data: [1, 2, 3, 4, 5, 6, 7, 8]}
rectification_matrix: {rows: 3, cols: 3, data: [1, 0, 0, 0, 1, 0, 0, 0, 1]}
projection_matrix: {rows: 3, cols: 4, data: [3500, 0, 2000, 0, 0, 3510, 1490, 0, 0, 0, 1, 0]}
)";
  folder_.write("camera.yaml", calibration);
  std::string indented = "camera:\n";
  for (std::size_t start = 0, end = 0; start < calibration.size(); start = end + 1) {
    end = calibration.find('\n', start);
    indented += "  " + calibration.substr(start, end - start) + "\n";
  }
  for (const std::string& text : {std::string("camera: camera.yaml\n"), indented}) {
    const PhotoSetup setup = read(text + scale + light);
    ASSERT_TRUE(setup.camera);
    EXPECT_EQ(setup.camera->fy, 3510);
    EXPECT_EQ(setup.camera->distortion, (std::array<double, 8>{1, 2, 3, 4, 5, 6, 7, 8}));
  }
  EXPECT_EQ(error_of([&] { read("camera: none.yaml\n" + scale + light); }),
            folder_.file("none.yaml") + ": cannot be read");
  folder_.write("camera.yaml", "image_width: 4000\nimage_height: high\n");
  EXPECT_EQ(error_of([&] { read("camera: camera.yaml\n" + scale + light); }),
            folder_.file("camera.yaml") + ":2: image_height is 'high', must be a number");
}

TEST_F(PhotoSetupFile, WithAKnownPoseThereNeedBeNoScale) {
  EXPECT_TRUE(read_photo_setup(folder_.write("setup.yaml", light), false).scale.empty());
}

TEST_F(PhotoSetupFile, MissingParts) {
  expect_refusal(light, ": there is no scale, must have straightedge.scale_px_mm or straightedge.markers");
  expect_refusal(scale, ": there is no light, must have light.elevation_deg, light.post or light.sun");
  expect_refusal(scale + "light: {azimuth_deg: 3}", ": there is no key 'light.elevation_deg'");
  expect_refusal(scale + "light: {}", ": there is no key 'light.elevation_deg'");
  expect_refusal(scale + "light: {post: {height_mm: 3, base_px: [1, 2]}}",
                 ": there is no key 'light.post.tip_px'");
  expect_refusal(scale + "light: {sun: {latitude_deg: 3}}", ": there is no key 'light.sun.utc'");
  expect_refusal("straightedge: {markers: {dictionary: DICT_4X4_50, centres_mm: [[0, 1, 1]]}}\n" + light,
                 ": there is no key 'straightedge.markers.size_mm'");
  expect_refusal("camera: {image_width: 10, image_height: 10}\n" + scale + light,
                 ": there is no key 'camera.camera_matrix'");
  expect_refusal("camera: {" + camera_keys + matrix + ", distortion_model: plumb_bob}\n" + scale + light,
                 ": there is no key 'camera.distortion_coefficients'");
}

TEST_F(PhotoSetupFile, UnknownKeysAndWrongTypes) {
  expect_refusal("", ":1: the file must be a section of 'key: value' lines");
  expect_refusal("just words", ":1: the file must be a section of 'key: value' lines");
  expect_refusal("a: [1, 2", ":1: end of sequence flow not found");
  expect_refusal(scale + light + "grain_mm: 0.3", ":3: unknown key 'grain_mm'");
  expect_refusal("straightedge: {scale: 3}\n" + light, ":1: unknown key 'straightedge.scale'");
  expect_refusal(scale + "light: {elevation_deg: 30, height: 3}", ":2: unknown key 'light.height'");
  expect_refusal(scale + light + "grain_diameter_mm: fine",
                 ":3: grain_diameter_mm is 'fine', must be a number");
  expect_refusal(scale + light + "grain_diameter_mm: -1",
                 ":3: grain_diameter_mm is '-1', must be from 0.01 to 20");
  expect_refusal(scale + light + "grain_diameter_mm: .nan",
                 ":3: grain_diameter_mm is '.nan', must be from 0.01 to 20");
  expect_refusal(scale + light + "wind_px: east", ":3: wind_px is 'east', must be a list of 2 numbers");
  expect_refusal(scale + light + "wind_px: [0, 0]", ":3: wind_px is [0, 0], must not be zero");
  expect_refusal(scale + "light: low", ":2: light must be a section of 'key: value' lines");
  expect_refusal("straightedge: [1]\n" + light, ":1: straightedge must be a section of 'key: value' lines");
  expect_refusal("straightedge: {scale_px_mm: 4}\n" + light,
                 ":1: straightedge.scale_px_mm is '4', must be a list of at least one");
  expect_refusal("straightedge: {scale_px_mm: [[1, 2, 3], [4, 5]]}\n" + light,
                 ":1: straightedge.scale_px_mm[1] is [4, 5], must be a list of 3 to 4 numbers");
  expect_refusal("straightedge: {scale_px_mm: [[1, 2, 3], [4, 5, ten]]}\n" + light,
                 ":1: straightedge.scale_px_mm[1] is 'ten', must be a number");
  expect_refusal(
      "straightedge: {line_px: [[1, 2]], scale_px_mm: [[1, 2, 3], [4, 5, 10]]}\n" + light,
      ":1: straightedge.line_px is [[1, 2]], must be at least two points [x, y] apart from one another");
  expect_refusal("straightedge: {line_px: [[1, 2], [3, 4, 5]]}\n" + light,
                 ":1: straightedge.line_px[1] is [3, 4, 5], must be a list of 2 numbers");
  expect_refusal("camera: {plumb: down}\n" + scale + light,
                 ":1: camera.plumb is 'down', must be true or false");
}

TEST_F(PhotoSetupFile, AnglesThatCannotBe) {
  for (const std::string angle : {"2.9", "85.1", "-30", "120"})
    expect_refusal(scale + "light: {elevation_deg: " + angle + "}",
                   ":2: light.elevation_deg is '" + angle + "', must be from 3 to 85");
  EXPECT_NO_THROW(read(scale + "light: {elevation_deg: 3}"));
  EXPECT_NO_THROW(read(scale + "light: {elevation_deg: 85}"));
  expect_refusal(scale + "light: {elevation_deg: 30, azimuth_deg: 90}",
                 ":2: light.azimuth_deg is '90', must be from -80 to 80");
  expect_refusal("straightedge: {shadow_side: 0, scale_px_mm: [[1, 2, 3], [4, 5, 10]]}\n" + light,
                 ":1: straightedge.shadow_side is '0', must be 1 (towards y > 0) or -1");
  expect_refusal("straightedge: {shadow_side: 1, scale_px_mm: [[1, 2, 3, 4], [4, 5, 10, 4]]}\n" + light,
                 ":1: straightedge.shadow_side is '1', must be away from the marks: the top face lies on the "
                 "light's side");
  expect_refusal("straightedge: {inclination_deg: 60, scale_px_mm: [[1, 2, 3], [4, 5, 10]]}\n" + light,
                 ":1: straightedge.inclination_deg is '60', must be from -45 to 45");
  const auto sun = [](const std::string& utc, const std::string& place) {
    return scale + "light: {sun: {utc: " + utc + ", " + place + ", north_px: [0, 1]}}";
  };
  expect_refusal(sun("noon", "latitude_deg: 40, longitude_deg: -105"),
                 ":2: light.sun.utc is 'noon', must be a time of UTC, like 2026-06-01T15:30:00Z");
  expect_refusal(sun("2003-10-17T19:30:30Z", "latitude_deg: 140, longitude_deg: -105"),
                 ":2: light.sun.latitude_deg is '140', must be from -90 to 90");
  expect_refusal(
      sun("2024-03-20T00:00:00Z", "latitude_deg: 0, longitude_deg: 0"),
      ":2: light.sun.utc is '2024-03-20T00:00:00Z', when the sun stood at -88.1 degrees there, must be a "
      "time with 3 to 85");
}

TEST_F(PhotoSetupFile, OneLightOnly) {
  expect_refusal(scale + "light: {elevation_deg: 30, post: 3}",
                 ":2: light.post is '3', must be the only form of light: angles, post or sun");
  expect_refusal(scale + "light: {post: {height_mm: 0, base_px: [1, 2], tip_px: [3, 4]}}",
                 ":2: light.post.height_mm is '0', must be positive");
  expect_refusal(scale + "light: {post: {height_mm: 10, base_px: [1, 2], tip_px: [1, 2]}}",
                 ":2: light.post.tip_px is [1, 2], must be another point than base_px");
}

TEST_F(PhotoSetupFile, MarksThatContradictOneAnother) {
  const auto marks = [](const std::string& list) {
    return "straightedge: {scale_px_mm: [" + list + "]}\n" + light;
  };
  const std::string start = ":1: straightedge.scale_px_mm";
  expect_refusal(marks("[1, 2, 3]"),
                 start + "[0] is [1, 2, 3], is the only mark, there must be at least two");
  expect_refusal(marks("[1, 2, 3], [5, 6, 10], [1, 2, 20]"),
                 start + "[2] is [1, 2, 20], has the pixel of mark 0, must be another");
  expect_refusal(marks("[1, 2, 3], [5, 6, 10], [8, 8, 3]"),
                 start + "[2] is [8, 8, 3], is the same mark as 0, at another pixel");
  expect_refusal(
      marks("[100, 50, 0], [200, 50, 10], [150, 50, 20], [400, 50, 30]"),
      start + "[2] is [150, 50, 20], lies the wrong way from x = 10 mm: x must rise or fall along a row");
  expect_refusal(marks("[100, 50, 0], [200, 50, 10], [450, 50, 20], [550, 50, 30]"),
                 start +
                     "[2] is [450, 50, 20], makes 25 px per mm after 10 between the marks before, must not "
                     "change by more than a factor of 2");
  expect_refusal(marks("[100, 50, 10, 0], [100, 90, 10, -5]"),
                 start + "[0] is [100, 50, 10, 0], has the x of all others, there must be two different");
  expect_refusal(
      marks("[100, 50, 0, 5], [200, 50, 10, -5]"),
      start +
          " is [[100, 50, 0, 5], [200, 50, 10, -5]], has y of both signs, must be on one side of the "
          "casting edge (y = 0)");
  // A scale whose x falls to the right, and two rows of different x, are fine.
  EXPECT_NO_THROW(read(marks("[500, 50, 0], [400, 50, 10], [300, 51, 20]")));
  EXPECT_NO_THROW(read(marks("[100, 50, 0, 0], [200, 50, 10, 0], [110, 90, 1, -5], [260, 90, 16, -5]")));
}

TEST_F(PhotoSetupFile, MarkersThatCannotBe) {
  const auto markers = [](const std::string& dictionary, const std::string& centres) {
    return "straightedge: {markers: {dictionary: " + dictionary + ", size_mm: 20, centres_mm: " + centres +
           "}}\n" + light;
  };
  const std::string start = ":1: straightedge.markers.";
  expect_refusal(markers("ARUCO", "[[0, 1, 2]]"),
                 start +
                     "dictionary is 'ARUCO', must be one of OpenCV's: DICT_4X4_50 to DICT_7X7_1000, "
                     "DICT_ARUCO_ORIGINAL, DICT_APRILTAG_16h5, 25h9, 36h10 or 36h11");
  expect_refusal(
      markers("DICT_4X4_50", "[[50, 1, 2]]"),
      start +
          "centres_mm[0] is [50, 1, 2], must start with a number of DICT_4X4_50: a whole one from 0 to 49");
  expect_refusal(
      markers("DICT_APRILTAG_36h11", "[[0.5, 1, 2]]"),
      start +
          "centres_mm[0] is [0.5, 1, 2], must start with a number of DICT_APRILTAG_36h11: a whole one "
          "from 0 to 586");
  expect_refusal(markers("DICT_4X4_50", "[[1, 0, -15], [1, 50, -15]]"),
                 start + "centres_mm[1] is [1, 50, -15], marker 1 is already in the list");
  expect_refusal(markers("DICT_4X4_50", "[[1, 0, -15], [2, 10, -15]]"),
                 start + "centres_mm[1] is [2, 10, -15], overlaps marker 1");
  expect_refusal(markers("DICT_4X4_50", "[[1, 0]]"),
                 start + "centres_mm[0] is [1, 0], must be a list of 3 numbers");
}

TEST_F(PhotoSetupFile, CamerasThatCannotBe) {
  const auto camera = [](const std::string& rest) { return "camera: {" + rest + "}\n" + scale + light; };
  expect_refusal(camera("image_width: 0, image_height: 10, camera_matrix: " + matrix),
                 ":1: camera.image_width is '0', must be from 1 to 1.04858e+06");
  expect_refusal(camera("image_width: 10.5, image_height: 10, camera_matrix: " + matrix),
                 ":1: camera.image_width is '10.5', must be a whole number");
  expect_refusal(camera(camera_keys + "[1, 2, 3]"),
                 ":1: camera.camera_matrix is [1, 2, 3], must be a list of 9 numbers");
  expect_refusal(camera(camera_keys + "{rows: 1, cols: 3, data: [1, 2, 3]}"),
                 ":1: camera.camera_matrix.data is [1, 2, 3], must be a list of 9 numbers");
  expect_refusal(camera(camera_keys + "{rows: 3, cols: 3, data: [1, 2, 3]}"),
                 ":1: camera.camera_matrix.data is [1, 2, 3], must be a list of 9 numbers");
  expect_refusal(camera(camera_keys + "[3500, 4, 2000, 0, 3510, 1490, 0, 0, 1]"),
                 ":1: camera.camera_matrix is [3500, 4, 2000, 0, 3510, 1490, 0, 0, 1], has a skew of 4, must "
                 "be without");
  expect_refusal(
      camera(camera_keys + "[-3500, 0, 2000, 0, 3510, 1490, 0, 0, 1]"),
      ":1: camera.camera_matrix is [-3500, 0, 2000, 0, 3510, 1490, 0, 0, 1], must be [fx, 0, cx, 0, fy, cy, "
      "0, 0, 1] with positive fx and fy");
  const auto lens = [&](const std::string& model, const std::string& values) {
    return camera(camera_keys + matrix + ", distortion_model: " + model +
                  ", distortion_coefficients: " + values);
  };
  expect_refusal(lens("fisheye", "[1, 2, 3, 4]"),
                 ":1: camera.distortion_model is 'fisheye', must be plumb_bob or rational_polynomial");
  expect_refusal(lens("plumb_bob", "[1, 2, 3]"),
                 ":1: camera.distortion_coefficients is [1, 2, 3], must be 4 or 5 numbers for plumb_bob");
  expect_refusal(
      lens("rational_polynomial", "[1, 2, 3, 4, 5]"),
      ":1: camera.distortion_coefficients is [1, 2, 3, 4, 5], must be 8 numbers for rational_polynomial");
}

}  // namespace
}  // namespace aeolian
