// measure_photo as people run it, on rendered photographs.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "../exif.hpp"
#include "../rendering/shadow_scene.hpp"
#include "../temporary_folder.hpp"
#include "program_outcome.hpp"
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <sys/wait.h>
#include <yaml-cpp/yaml.h>

#include "aeolian_core/surface/csv.hpp"

namespace aeolian {
namespace {

namespace fs = std::filesystem;

constexpr double wavelength = 0.040;
constexpr double ripple_height = 0.003;
constexpr double migration = 1e-3 / 60;  ///< [m/s]
constexpr int photo_interval = 120;      ///< [s]

/// Ripples that move to larger x, under a camera straight above a strip of markers.
ShadowScene scene_at(double time) {
  ShadowScene scene;
  scene.bed = [time](double x, double) {
    return -0.012 + 0.5 * ripple_height * std::sin(2 * M_PI * (x - migration * time) / wavelength);
  };
  PhotoSetup::Markers markers{"DICT_4X4_50", 0.02, {}};
  for (int i = 0; i < 8; ++i) markers.centres.push_back({i, {0.04 * (i - 3.5), -0.015}});
  scene.markers = markers;
  scene.from = -0.17;
  scene.to = 0.17;
  scene.elevation = 0.6;
  scene.azimuth = 0.1;
  scene.grain_diameter = 0.0003;
  scene.camera.width_px = 1600;
  scene.camera.height_px = 800;
  scene.camera.fx = scene.camera.fy = 1700;
  scene.camera.cx = 800;
  scene.camera.cy = 400;
  const Eigen::Vector3d place(0, 0, 0.4);
  scene.level_to_camera.linear() = Eigen::Vector3d(1, -1, -1).asDiagonal();
  scene.level_to_camera.translation() = -(scene.level_to_camera.linear() * place);
  scene.seed = static_cast<std::uint64_t>(1 + time);
  return scene;
}

const std::string camera =
    "camera: {image_width: 1600, image_height: 800, camera_matrix: [1700, 0, 800, 0, 1700, 400, 0, 0, 1]}\n";
const std::string strip =
    "straightedge: {markers: {dictionary: DICT_4X4_50, size_mm: 20, centres_mm: [[0, -140, -15], [1, -100, "
    "-15], "
    "[2, -60, -15], [3, -20, -15], [4, 20, -15], [5, 60, -15], [6, 100, -15], [7, 140, -15]]}}\n";
const std::string light = "light: {elevation_deg: 34.37747, azimuth_deg: 5.729578}\n";
const std::string rest = "grain_diameter_mm: 0.3\nwind_px: [1, 0]\n";

class MeasurePhoto : public testing::Test {
 protected:
  /// The photos are rendered once: each takes a second.
  static void SetUpTestSuite() {
    rendered_ = std::make_unique<TemporaryFolder>();
    for (int i = 0; i < 3; ++i) {
      const std::string path = rendered_->file("plain.jpg");
      write_jpeg(scene_at(photo_interval * i), path);
      const int seconds = photo_interval * i;
      rendered_->write(name_of(i),
                       with_exif(content_of(path), 1, 28,
                                 fmt::format("2026:06:01 15:{:02}:{:02}", seconds / 60, seconds % 60)));
      fs::remove(path);
    }
  }
  static void TearDownTestSuite() { rendered_.reset(); }
  static std::string name_of(int photo) { return fmt::format("kelso_{}.jpg", photo); }
  static std::string bytes_of(int photo) { return content_of(rendered_->file(name_of(photo))); }

  MeasurePhoto() { setup(camera + strip + light + rest); }

  void setup(const std::string& text) const { folder_.write("setup.yaml", text); }
  Outcome run(const std::string& arguments) const {
    return run_program("measure_photo " + arguments, folder_.path());
  }
  /// Expects exit code 1, this one line, and no file more than before.
  void expect_refusal(const std::string& arguments, const std::string& line) const {
    const std::size_t before = folder_.count_files();
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_EQ(outcome.err, "measure_photo: " + line + "\n");
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(folder_.count_files(), before);
  }
  YAML::Node summary(const std::string& name) const { return YAML::LoadFile(folder_.file(name)); }
  /// Mean wavelength and height are those of the bed.
  void expect_the_ripples(const std::string& name) const {
    const YAML::Node ripples = summary(name)["ripples"];
    EXPECT_GE(ripples["count"].as<int>(), 5) << name;
    EXPECT_NEAR(ripples["wavelength_mm"].as<double>(), 1e3 * wavelength, 0.005 * 1e3 * wavelength) << name;
    EXPECT_NEAR(ripples["height_mm"].as<double>(), 1e3 * ripple_height, 0.08) << name;
  }

  static std::unique_ptr<TemporaryFolder> rendered_;
  const TemporaryFolder folder_;
};
std::unique_ptr<TemporaryFolder> MeasurePhoto::rendered_;

TEST_F(MeasurePhoto, OnePhotoBesideIt) {
  folder_.write("kelso.jpg", bytes_of(0));
  const Outcome outcome = run("kelso.jpg --setup setup.yaml");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
  EXPECT_EQ(outcome.out.find("kelso.jpg: "), 0U) << outcome.out;
  EXPECT_NE(outcome.out.find(" ripples, wavelength "), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" -> .\n"), std::string::npos) << outcome.out;
  EXPECT_EQ(folder_.count_files(), 8U);  // photo, setup and six results
  expect_the_ripples("kelso_summary.yaml");

  const YAML::Node all = summary("kelso_summary.yaml");
  EXPECT_EQ(all["mode"].as<std::string>(), "full");
  EXPECT_EQ(all["camera_time"].as<std::string>(), "2026-06-01T15:00:00Z");
  EXPECT_NEAR(all["light"]["elevation_deg"].as<double>(), 34.377, 0.01);
  EXPECT_NEAR(all["camera"]["scale_px_per_mm"].as<double>(), 4.25, 0.05);
  EXPECT_EQ(all["each_ripple"].size(), all["ripples"]["count"].as<std::size_t>());
  EXPECT_GT(all["ripples"]["sigma_wavelength_mm"].as<double>(), 0);

  const Table profile = read_csv(folder_.file("kelso_profile.csv"));
  const std::vector<std::string> names = {"x_mm",          "z_mm",          "sigma_z_mm", "y_mm",
                                          "terminus_x_px", "terminus_y_px", "spread_mm"};
  EXPECT_EQ(profile.names, names);
  EXPECT_GT(profile.rows(), 500U);
  EXPECT_NEAR(profile.column("y_mm")[0], 12 / std::tan(0.6) * std::cos(0.1), 4);

  const cv::Mat photo = cv::imread(folder_.file("kelso.jpg"));
  const cv::Mat overlay = cv::imread(folder_.file("kelso_overlay.jpg"));
  EXPECT_EQ(overlay.size(), photo.size());
  EXPECT_NE(content_of(folder_.file("kelso_profile.svg")).find("times exaggerated"), std::string::npos);
  EXPECT_GT(read_csv(folder_.file("kelso_length_scales.csv")).column("lag_mm").size(), 50U);
  EXPECT_GT(read_csv(folder_.file("kelso_spectrum.csv")).column("power_mm3").size(), 50U);
}

TEST_F(MeasurePhoto, OverheadModeIntoAFolder) {
  folder_.write("kelso.jpg", bytes_of(0));
  const Outcome outcome = run("kelso.jpg --setup setup.yaml --out a/b --mode overhead");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find(" -> a/b\n"), std::string::npos);
  EXPECT_EQ(summary("a/b/kelso_summary.yaml")["mode"].as<std::string>(), "overhead");
  EXPECT_EQ(folder_.count_files(), 3U);
}

TEST_F(MeasurePhoto, AFolderIsASeries) {
  for (int i = 0; i < 3; ++i) folder_.write(name_of(i), bytes_of(i));
  for (int again = 0; again < 2; ++again) {  // overlays of the first run are no photos
    const Outcome outcome = run(". --setup setup.yaml");
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 4) << outcome.out;
    EXPECT_NE(outcome.out.find("3 photos, migration "), std::string::npos) << outcome.out;
  }
  const YAML::Node all = summary("series_summary.yaml");
  EXPECT_NEAR(all["migration_mm_per_min"].as<double>(), 1e3 * 60 * migration, 0.05);
  EXPECT_NEAR(all["growth_mm_per_min"].as<double>(), 0, 0.02);
  EXPECT_EQ(all["events"].size(), 0U);
  const std::string csv = content_of(folder_.file("series.csv"));
  EXPECT_EQ(csv.find("photo,time_s,ripples,wavelength_mm,"), 0U);
  EXPECT_NE(csv.find("\nkelso_0.jpg,0,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("\nkelso_2.jpg,240,"), std::string::npos) << csv;
  EXPECT_NE(content_of(folder_.file("series.svg")).find("Migration "), std::string::npos);
}

TEST_F(MeasurePhoto, WithoutTimesThereAreNoRates) {
  for (int i = 0; i < 2; ++i) {
    cv::Mat photo = cv::imread(rendered_->file(name_of(i)));
    cv::imwrite(folder_.file(name_of(i)), photo, {cv::IMWRITE_JPEG_QUALITY, 95});
  }
  const Outcome outcome = run(folder_.path() + " --setup setup.yaml --out results");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(
      outcome.out.find("2 photos; no rates: the photos have no camera times (EXIF), so they are in order of "
                       "their names -> results\n"),
      std::string::npos)
      << outcome.out;
  EXPECT_FALSE(summary("results/series_summary.yaml")["migration_mm_per_min"]);
  EXPECT_EQ(content_of(folder_.file("results/series.svg")).find("Migration"), std::string::npos);
}

TEST_F(MeasurePhoto, OtherKindsOfFileGiveTheSame) {
  const cv::Mat photo = cv::imread(rendered_->file(name_of(0)));
  cv::Mat grey16;
  cv::imread(rendered_->file(name_of(0)), cv::IMREAD_GRAYSCALE).convertTo(grey16, CV_16U, 257);
  cv::imwrite(folder_.file("grey16.png"), grey16);
  cv::Mat turned;
  cv::rotate(photo, turned, cv::ROTATE_90_COUNTERCLOCKWISE);  // as a camera held upright stores it
  cv::imwrite(folder_.file("turned.jpg"), turned, {cv::IMWRITE_JPEG_QUALITY, 95});
  folder_.write("turned.jpg", with_exif(content_of(folder_.file("turned.jpg")), 6, 28, ""));
  const Outcome outcome = run("grey16.png turned.jpg --setup setup.yaml");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  for (const std::string name : {"grey16", "turned"}) {
    expect_the_ripples(name + "_summary.yaml");
    EXPECT_EQ(cv::imread(folder_.file(name + "_overlay.jpg")).size(), photo.size()) << name;
  }
}

TEST_F(MeasurePhoto, APhotoThatFailsDoesNotStopTheOthers) {
  fs::create_directory(folder_.file("photos"));
  folder_.write("photos/a.jpg", bytes_of(0).substr(0, bytes_of(0).size() / 2));
  folder_.write("photos/b.jpg", bytes_of(0));
  cv::imwrite(folder_.file("photos/c.png"), cv::Mat(800, 1600, CV_8UC3, cv::Scalar(120, 150, 170)));
  const Outcome outcome = run("photos --setup setup.yaml --out results");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(
      outcome.err.find("measure_photo: photo 'photos/a.jpg': is truncated or damaged (Premature end of JPEG "
                       "file)\nmeasure_photo: photo 'photos/c.png': "),
      0U)
      << outcome.err;
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 2) << outcome.err;
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 1) << outcome.out;
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_.file("results")), fs::directory_iterator()), 6);
}

TEST_F(MeasurePhoto, BadInputIsToldInOneLine) {
  folder_.write("photo.jpg", bytes_of(0));
  const std::string photo = "photo 'photo.jpg': ";
  expect_refusal("--setup setup.yaml", "there is no PHOTO, see --help");
  expect_refusal("photo.jpg", "--setup is missing, see --help");
  expect_refusal("photo.jpg --setup none.yaml", "none.yaml: cannot be read");
  expect_refusal("none.jpg --setup setup.yaml", "photo 'none.jpg': No such file or directory");
  expect_refusal("setup.yaml --setup setup.yaml", "photo 'setup.yaml': is not a JPEG, PNG or TIFF picture");
  fs::create_directory(folder_.file("empty"));
  expect_refusal("empty --setup setup.yaml", "folder 'empty': has no JPEG, PNG or TIFF photo");
  folder_.write("photo.png", "");
  expect_refusal("photo.jpg photo.png --setup setup.yaml",
                 "photos 'photo.jpg' and 'photo.png': would both write photo_profile.csv");
  expect_refusal("photo.png --setup setup.yaml", "photo 'photo.png': is empty");
  setup(camera + strip + "light: {elevation_deg: 87}\n");
  expect_refusal("photo.jpg --setup setup.yaml",
                 "setup.yaml:3: light.elevation_deg is '87', must be from 3 to 85");
  setup(strip + light + "grain: 3\n");
  expect_refusal("photo.jpg --setup setup.yaml", "setup.yaml:3: unknown key 'grain'");
}

TEST_F(MeasurePhoto, SizesThatDifferAreRefused) {
  cv::imwrite(folder_.file("small.jpg"), cv::Mat(400, 800, CV_8UC3, cv::Scalar(120, 150, 170)));
  const Outcome outcome = run("small.jpg --setup setup.yaml --out results");
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  for (const std::string part : {"photo 'small.jpg': ", "800", "400", "1600"})
    EXPECT_NE(outcome.err.find(part), std::string::npos) << outcome.err;
  EXPECT_TRUE(fs::is_empty(folder_.file("results")));
}

TEST_F(MeasurePhoto, PrintsAStrip) {
  const Outcome outcome = run("--print-strip strip.pdf --strip-length-mm 400 --marker-mm 20");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out.find("strip.pdf: 420 mm x "), 0U) << outcome.out;
  EXPECT_EQ(content_of(folder_.file("strip.pdf")).find("%PDF"), 0U);
  const YAML::Node markers = summary("strip.yaml")["straightedge"]["markers"];
  EXPECT_EQ(markers["size_mm"].as<double>(), 20);
  EXPECT_EQ(markers["centres_mm"].size(), 14U);
  EXPECT_EQ(run("--strip-length-mm 400").code, 1);
  expect_refusal("--print-strip none/strip.pdf", "cannot write 'none/strip.pdf': No such file or directory");
  expect_refusal("--print-strip wide.pdf --marker-mm 2", "strip: markers of 2 mm, must be from 5 to 100");
}

}  // namespace
}  // namespace aeolian
