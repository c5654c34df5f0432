#include "aeolian_twin/photo/printed_strip.hpp"

#include <map>
#include <vector>

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

namespace aeolian {
namespace {

constexpr double px_per_mm = 8;

cv::Mat printed(const PrintedStrip& strip, std::size_t page) {
  cv::Mat picture(static_cast<int>(210 * px_per_mm), static_cast<int>(297 * px_per_mm), CV_8UC4);
  cairo_surface_t* surface = cairo_image_surface_create_for_data(
      picture.data, CAIRO_FORMAT_RGB24, picture.cols, picture.rows, static_cast<int>(picture.step));
  cairo_t* cairo = cairo_create(surface);
  cairo_scale(cairo, px_per_mm, px_per_mm);
  strip.draw(cairo, page);
  cairo_destroy(cairo);
  cairo_surface_destroy(surface);
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_BGRA2GRAY);
  return grey;
}

/// The corners of the markers on a page as OpenCV finds them, from the upper left corner of each [mm].
std::map<int, std::vector<cv::Point2f>> detected(const cv::Mat& page) {
  std::vector<int> ids;
  std::vector<std::vector<cv::Point2f>> corners;
  auto parameters = cv::aruco::DetectorParameters::create();
  parameters->cornerRefinementMethod = cv::aruco::CORNER_REFINE_SUBPIX;
  cv::aruco::detectMarkers(page, cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50), corners, ids,
                           parameters);
  std::map<int, std::vector<cv::Point2f>> result;
  for (std::size_t i = 0; i < ids.size(); ++i)
    for (const cv::Point2f& corner : corners[i])
      result[ids[i]].push_back((corner + cv::Point2f(0.5F, 0.5F)) / px_per_mm);
  return result;
}

/// Every marker is where the strip says, upright with x to the right and y up, piece by piece.
void expect_true_to_scale(const PrintedStrip& strip) {
  std::size_t found = 0;
  for (std::size_t page = 0; page < strip.pages(); ++page) {
    std::map<int, Eigen::Vector2d> origins;  // of the strip's frame on the page, by the piece's height on it
    for (const auto& [id, corners] : detected(printed(strip, page))) {
      ++found;
      const auto& centre = strip.markers().centres.at(static_cast<std::size_t>(id));
      const double half = 500 * strip.markers().size;
      const std::vector<Eigen::Vector2d> offsets = {
          {-half, half}, {half, half}, {half, -half}, {-half, -half}};
      Eigen::Vector2d origin = Eigen::Vector2d::Zero();
      for (std::size_t k = 0; k < 4; ++k) {
        const Eigen::Vector2d place = 1000 * centre.position + offsets[k];
        origin += Eigen::Vector2d(corners[k].x - place.x(), corners[k].y + place.y()) / 4;
      }
      for (std::size_t k = 0; k < 4; ++k) {
        const Eigen::Vector2d place = 1000 * centre.position + offsets[k];
        EXPECT_NEAR(corners[k].x, origin.x() + place.x(), 0.05) << id;
        EXPECT_NEAR(corners[k].y, origin.y() - place.y(), 0.05) << id;
      }
      const auto first = origins.emplace(static_cast<int>(origin.y() + 0.5), origin).first;
      EXPECT_NEAR((origin - first->second).norm(), 0, 0.05) << id;
    }
  }
  EXPECT_EQ(found, strip.markers().centres.size());
}

TEST(PrintedStrip, MarkersAreFoundWhereItSays) {
  expect_true_to_scale(PrintedStrip(0.5, 0.014));
  expect_true_to_scale(PrintedStrip(1.0, 0.015));
  expect_true_to_scale(PrintedStrip(0.9, 0.028));
}

TEST(PrintedStrip, FitsAStraightedgeOf25Millimetres) {
  const PrintedStrip strip(0.5, 0.014);
  EXPECT_NEAR(strip.length(), 0.5, 1e-12);
  EXPECT_LE(strip.width(), 0.0254);
  EXPECT_EQ(strip.pieces(), 2U);
  EXPECT_EQ(strip.pages(), 1U);
}

TEST(PrintedStrip, LinesMeasureWhatTheySay) {
  const cv::Mat page = printed(PrintedStrip(0.5, 0.014), 0);
  // The longest dark run of the check line's rows is the line of 100 mm.
  int longest = 0;
  for (int row = static_cast<int>(32.5 * px_per_mm); row < static_cast<int>(33.5 * px_per_mm); ++row)
    for (int column = 0, run = 0; column < page.cols; ++column) {
      run = page.at<std::uint8_t>(row, column) < 128 ? run + 1 : 0;
      longest = std::max(longest, run);
    }
  EXPECT_NEAR(longest / px_per_mm, 100, 0.4);
}

TEST(PrintedStrip, ItsYamlIsWhatTheSetupFileTakes) {
  const TemporaryFolder folder;
  const PrintedStrip strip(0.5, 0.014);
  const std::string yaml = write_strip(strip, folder.file("strip.pdf"));
  EXPECT_EQ(yaml, folder.file("strip.yaml"));
  EXPECT_EQ(content_of(folder.file("strip.pdf")).substr(0, 5), "%PDF-");
  const PhotoSetup setup =
      read_photo_setup(folder.write("setup.yaml", content_of(yaml) + "light: {elevation_deg: 30}\n"));
  ASSERT_TRUE(setup.markers);
  EXPECT_EQ(setup.markers->dictionary, "DICT_4X4_50");
  EXPECT_NEAR(setup.markers->size, 0.014, 1e-12);
  ASSERT_EQ(setup.markers->centres.size(), strip.markers().centres.size());
  for (std::size_t i = 0; i < setup.markers->centres.size(); ++i) {
    EXPECT_EQ(setup.markers->centres[i].id, strip.markers().centres[i].id);
    EXPECT_NEAR((setup.markers->centres[i].position - strip.markers().centres[i].position).norm(), 0, 1e-9);
  }
}

TEST(PrintedStrip, RefusesWhatCannotBePrinted) {
  EXPECT_EQ(error_of([] { PrintedStrip(0.5, 0.002); }), "strip: markers of 2 mm, must be from 5 to 100");
  EXPECT_EQ(error_of([] { PrintedStrip(1.2, 0.014); }),
            "strip: a length of 1200 mm, must be up to 1000 with markers of 14 mm");
  EXPECT_EQ(error_of([] { PrintedStrip(0, 0.014); }),
            "strip: a length of 0 mm, must be up to 1000 with markers of 14 mm");
  const TemporaryFolder folder;
  EXPECT_NE(
      error_of([&] { write_strip(PrintedStrip(0.5, 0.014), folder.file("none/strip.pdf")); }).find("none"),
      std::string::npos);
}

}  // namespace
}  // namespace aeolian
