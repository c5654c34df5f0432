#include "aeolian_core/surface/preview.hpp"

#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

namespace aeolian {
namespace {

class Preview : public testing::Test {
 protected:
  /// Draws a map and reads the picture back.
  cv::Mat draw(const HeightMap& map, const PreviewOptions& options) const {
    const std::string path = folder_.file("map.png");
    write_preview(map, path, options);
    EXPECT_EQ(content_of(path).substr(0, 8), "\x89PNG\r\n\x1a\n");
    EXPECT_EQ(folder_.count_files(), 1U);
    return cv::imread(path);
  }
  TemporaryFolder folder_;
};

bool is(const cv::Vec3b& pixel, const Rgb& c) {
  return pixel[2] == c[0] && pixel[1] == c[1] && pixel[0] == c[2];
}

/// The pixels of a colour in the left part of a picture, where the colour bar is not.
cv::Rect where(const cv::Mat& picture, const Rgb& colour, int width, int* count) {
  cv::Rect box;
  *count = 0;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < width; ++x)
      if (is(picture.at<cv::Vec3b>(y, x), colour)) {
        ++*count;
        box = box.empty() ? cv::Rect(x, y, 1, 1) : box | cv::Rect(x, y, 1, 1);
      }
  return box;
}

TEST_F(Preview, ShowsEveryCellWhereItIsNorthUpEnlargedByAWholeFactor) {
  HeightMap map(GridGeometry(0, 0, 0.1, 60, 40));
  auto& values = map.add(layer::elevation);
  const double quarter[2][2] = {{0.1, 0.4}, {0.6, 0.9}};  // [north][east]
  for (std::size_t i = 0; i < values.size(); ++i) {
    const CellIndex cell = map.geometry().cell_at(i);
    values[i] = static_cast<float>(quarter[cell.y >= 20][cell.x >= 30]);
  }
  PreviewOptions options;
  options.range = {0, 1};
  options.relief = false;
  options.width_px = 500;  // factor 8
  const cv::Mat picture = draw(map, options);
  cv::Rect south_west;
  for (const int north : {0, 1})
    for (const int east : {0, 1}) {
      int count = 0;
      const Rgb c = colour(Palette::sand, static_cast<double>(static_cast<float>(quarter[north][east])));
      const cv::Rect box = where(picture, c, 510, &count);
      if (north == 0 && east == 0) south_west = box;
      EXPECT_EQ(count, 30 * 20 * 8 * 8);
      EXPECT_EQ(box, cv::Rect(south_west.x + east * 240, south_west.y - north * 160, 240, 160));
    }
}

TEST_F(Preview, HasTheMapsSizeBesideTheSameMargins) {
  const auto size = [&](int nx, int ny, const std::string& title) {
    HeightMap map(GridGeometry(0, 0, 0.01, nx, ny));
    map.add(layer::elevation, 0.5F);
    PreviewOptions options;
    options.width_px = 400;
    options.title = title;
    return draw(map, options).size();
  };
  const cv::Size small = size(200, 100, "");
  EXPECT_EQ(size(100, 50, ""), small) << "enlarged four times instead of twice";
  EXPECT_EQ(size(2000, 1000, ""), small) << "reduced";
  EXPECT_EQ(size(200, 200, "").height, small.height + 200);
  EXPECT_EQ(size(100, 200, "").width, small.width - 200);
  EXPECT_GT(size(200, 100, "Title").height, small.height);
}

TEST_F(Preview, HatchesUnknownCells) {
  HeightMap map(GridGeometry(0, 0, 1, 40, 40));
  map.add(layer::elevation);
  const cv::Mat picture = draw(map, {});
  const cv::Mat middle = picture(cv::Rect(200, 200, 16, 16));
  double low = 0;
  double high = 0;
  cv::minMaxLoc(middle.reshape(1), &low, &high);
  EXPECT_LT(low, 200);
  EXPECT_GT(high, 200);
}

TEST_F(Preview, NamesTheLayerOrTheFile) {
  HeightMap map(GridGeometry(0, 0, 1, 2, 2));
  EXPECT_NE(error_of([&] { write_preview(map, folder_.file("a.png")); }).find("'elevation'"),
            std::string::npos);
  map.add(layer::elevation, 0);
  const std::string file = folder_.write("file", "");
  EXPECT_NE(error_of([&] { write_preview(map, file + "/a.png"); }).find("Not a directory"),
            std::string::npos);
  EXPECT_NE(error_of([&] { write_preview(map, folder_.file("a.doc")); }).find("a.doc"), std::string::npos);
  PreviewOptions options;
  options.width_px = 0;
  EXPECT_NE(error_of([&] { write_preview(map, folder_.file("a.png"), options); }).find("0 px"),
            std::string::npos);
  EXPECT_EQ(folder_.count_files(), 1U);
}

}  // namespace
}  // namespace aeolian
