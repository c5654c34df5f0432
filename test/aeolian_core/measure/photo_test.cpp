#include "aeolian_core/measure/photo.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <vector>

#include "../../exif.hpp"
#include "../../temporary_folder.hpp"
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

namespace aeolian {
namespace {

constexpr int width = 64;
constexpr int height = 48;

/// A grey picture whose corners differ: dark upper left, bright lower right, the upper right between.
cv::Mat grey_picture() {
  cv::Mat picture(height, width, CV_8UC1);
  for (int row = 0; row < height; ++row)
    for (int column = 0; column < width; ++column)
      picture.at<std::uint8_t>(row, column) = static_cast<std::uint8_t>(20 + column + 3 * row);
  return picture;
}

cv::Mat flat(int type, const cv::Scalar& colour) { return {height, width, type, colour}; }

std::string encoded(const std::string& extension, const cv::Mat& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(extension, picture, bytes, {cv::IMWRITE_JPEG_QUALITY, 98});
  return {bytes.begin(), bytes.end()};
}

double mean(const Photo& photo) {
  double sum = 0;
  for (const auto value : photo.values8) sum += value;
  for (const auto value : photo.values16) sum += value;
  return sum / (photo.width_px * photo.height_px);
}

class PhotoFile : public testing::Test {
 protected:
  Photo read(const std::string& name, const std::string& bytes) const {
    return read_photo(folder_.write(name, bytes));
  }
  /// Expects one line that names the file and then says `reason`.
  void expect_refusal(const std::string& name, const std::string& bytes, const std::string& reason) const {
    const std::string path = folder_.write(name, bytes);
    EXPECT_EQ(error_of([&] { read_photo(path); }), "photo '" + path + "': " + reason);
  }
  std::string converted(const std::string& arguments, const std::string& name) const {
    const std::string path = folder_.file(name);
    const std::string command = "convert -size 64x48 " + arguments + " " + path;
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return path;
  }

  const TemporaryFolder folder_;
};

TEST_F(PhotoFile, GreyJpegPngAndTiff) {
  const cv::Mat picture = grey_picture();
  for (const std::string extension : {".jpg", ".png", ".tif"}) {
    const Photo photo = read("photo" + extension, encoded(extension, picture));
    ASSERT_EQ(photo.width_px, width) << extension;
    ASSERT_EQ(photo.height_px, height);
    EXPECT_EQ(photo.white, 255);
    ASSERT_EQ(photo.values8.size(), picture.total());
    EXPECT_TRUE(photo.values16.empty());
    for (std::size_t i = 0; i < photo.values8.size(); ++i)
      EXPECT_NEAR(photo.values8[i], picture.data[i], extension == ".jpg" ? 2 : 0);
    EXPECT_FALSE(photo.exif_focal_px);
    EXPECT_FALSE(photo.exif_time);
  }
}

TEST_F(PhotoFile, ColoursBecomeLuma) {
  const double luma = 0.299 * 200 + 0.587 * 120 + 0.114 * 40;  // ITU-R BT.601, as in JPEG
  for (const std::string extension : {".jpg", ".png", ".tif"})
    EXPECT_NEAR(mean(read("c" + extension, encoded(extension, flat(CV_8UC3, {40, 120, 200})))), luma, 1);
  for (const std::string extension : {".png", ".tif"}) {
    const Photo photo =
        read("c16" + extension, encoded(extension, flat(CV_16UC3, {40 * 257, 120 * 257, 200 * 257})));
    EXPECT_EQ(photo.white, 65535);
    EXPECT_TRUE(photo.values8.empty());
    EXPECT_NEAR(mean(photo), 257 * luma, 100);
  }
}

TEST_F(PhotoFile, SixteenBitsAreKept) {
  cv::Mat picture(height, width, CV_16UC1);
  for (int i = 0; i < width * height; ++i)
    picture.at<std::uint16_t>(i / width, i % width) = static_cast<std::uint16_t>(21 * i);
  for (const std::string extension : {".png", ".tif"}) {
    const Photo photo = read("g16" + extension, encoded(extension, picture));
    ASSERT_EQ(photo.values16.size(), picture.total());
    for (std::size_t i = 0; i < photo.values16.size(); ++i) EXPECT_EQ(photo.values16[i], 21 * i);
  }
}

TEST_F(PhotoFile, AlphaIsIgnored) {
  for (const std::string extension : {".png", ".tif"})
    EXPECT_NEAR(mean(read("a" + extension, encoded(extension, flat(CV_8UC4, {90, 90, 90, 7})))), 90, 0.5);
  EXPECT_NEAR(mean(read("a16.png", encoded(".png", flat(CV_16UC4, {9000, 9000, 9000, 7})))), 9000, 1);
  EXPECT_NEAR(mean(read("a16.tif", encoded(".tif", flat(CV_16UC4, {9000, 9000, 9000, 7})))), 9000, 1);
}

TEST_F(PhotoFile, PalettesAndFewBits) {
  EXPECT_NEAR(mean(read_photo(converted("xc:'rgb(200,120,40)' -type Palette", "palette.png"))), 134.8, 1);
  EXPECT_NEAR(mean(read_photo(converted("xc:white -type Bilevel", "bits.png"))), 255, 0);
  EXPECT_NEAR(mean(read_photo(converted("xc:white -type Bilevel -compress Group4", "bits.tif"))), 255, 0);
}

TEST_F(PhotoFile, CmykJpeg) {
  const std::string colour = converted("xc:'rgb(200,120,40)' -colorspace CMYK -quality 98", "cmyk.jpg");
  EXPECT_NEAR(mean(read_photo(colour)), 134.8, 2);
  // Without Adobe's marker the stored numbers are inks, not light: here cyan 0, magenta and yellow 128 (the
  // chroma of grey), black 60.
  std::string bytes = content_of(converted("xc:'rgb(60,60,60)' -colorspace CMYK -quality 98", "grey.jpg"));
  EXPECT_NEAR(mean(read("grey.jpg", bytes)), 60, 1);
  const std::size_t marker = bytes.find(std::string("\xFF\xEE\0\x0E", 4) + "Adobe");
  ASSERT_NE(marker, std::string::npos);
  bytes.erase(marker, 16);
  EXPECT_NEAR(mean(read("plain.jpg", bytes)), (0.299 * 255 + 0.701 * 127) * (255 - 60) / 255, 2);
}

// EXIF 2.3, tag 0x0112: where the stored row 0 and column 0 are on the upright picture.
TEST_F(PhotoFile, IsUprightInAllEightOrientations) {
  const cv::Mat stored = grey_picture();
  const auto shown = [&](int orientation, int row, int column) -> int {
    const int bottom = height - 1;
    const int right = width - 1;
    switch (orientation) {
      case 2:
        return stored.at<std::uint8_t>(row, right - column);
      case 3:
        return stored.at<std::uint8_t>(bottom - row, right - column);
      case 4:
        return stored.at<std::uint8_t>(bottom - row, column);
      case 5:
        return stored.at<std::uint8_t>(column, row);
      case 6:
        return stored.at<std::uint8_t>(bottom - column, row);
      case 7:
        return stored.at<std::uint8_t>(bottom - column, right - row);
      case 8:
        return stored.at<std::uint8_t>(column, right - row);
      default:
        return stored.at<std::uint8_t>(row, column);
    }
  };
  const std::vector<std::string> names = {"TopLeft", "TopRight", "BottomRight", "BottomLeft",
                                          "LeftTop", "RightTop", "RightBottom", "LeftBottom"};
  const std::string plain = folder_.write("plain.tif", encoded(".tif", stored));
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const Photo jpeg =
        read("photo.jpg", with_exif(encoded(".jpg", stored), orientation, 28, "2026:06:01 15:30:00"));
    const std::string& name = names[static_cast<std::size_t>(orientation - 1)];
    const Photo tiff = read_photo(converted(plain + " -orient " + name, "photo.tif"));
    for (const Photo* photo : {&jpeg, &tiff}) {
      ASSERT_EQ(photo->width_px, orientation < 5 ? width : height) << orientation;
      ASSERT_EQ(photo->height_px, orientation < 5 ? height : width) << orientation;
      for (int row = 0; row < photo->height_px; ++row)
        for (int column = 0; column < photo->width_px; ++column)
          ASSERT_NEAR(photo->values8[static_cast<std::size_t>(row * photo->width_px + column)],
                      shown(orientation, row, column), 2)
              << orientation << ' ' << row << ' ' << column;
    }
  }
}

TEST_F(PhotoFile, FocalLengthAndTimeOfTheExifData) {
  const std::string jpeg = encoded(".jpg", grey_picture());
  const Photo photo = read("photo.jpg", with_exif(jpeg, 1, 28, "2026:06:01 15:30:00"));
  ASSERT_TRUE(photo.exif_focal_px);
  EXPECT_NEAR(*photo.exif_focal_px, 28 / 43.2666 * 80, 1e-3);  // 64 x 48: a diagonal of 80 px
  ASSERT_TRUE(photo.exif_time);
  EXPECT_EQ(*photo.exif_time, 1780327800);

  const Photo unknown = read("photo.jpg", with_exif(jpeg, 0, 0, "    :  :     :  :  "));
  EXPECT_FALSE(unknown.exif_focal_px);
  EXPECT_FALSE(unknown.exif_time);
}

TEST_F(PhotoFile, DamagedExifDataDoNoHarm) {
  std::string jpeg = with_exif(encoded(".jpg", grey_picture()), 6, 28, "2026:06:01 15:30:00");
  for (std::size_t i = 20; i < 60; ++i) jpeg[i] = '\xFF';
  EXPECT_EQ(read("photo.jpg", jpeg).width_px, width);
}

TEST_F(PhotoFile, TruncatedFilesAreRefusedWhereverTheyEnd) {
  const cv::Mat picture = grey_picture();
  for (const std::string extension : {".jpg", ".png", ".tif"}) {
    const std::string whole = encoded(extension, picture);
    for (const double part : {0.05, 0.3, 0.6, 0.9, 0.99}) {
      const auto size = static_cast<std::size_t>(part * static_cast<double>(whole.size()));
      const std::string path = folder_.write("cut" + extension, whole.substr(0, size));
      const std::string line = error_of([&] {
        const Photo photo = read_photo(path);  // a TIFF can be whole without its last, unimportant, entry
        EXPECT_EQ(extension, ".tif");
        EXPECT_TRUE(std::equal(photo.values8.begin(), photo.values8.end(), picture.datastart));
        throw Error("photo '" + path + "': is truncated or damaged");
      });
      EXPECT_EQ(line.find("photo '" + path + "': is truncated or damaged"), 0U) << part << ' ' << line;
      EXPECT_EQ(line.find('\n'), std::string::npos);
    }
  }
  std::string jpeg = encoded(".jpg", picture);
  jpeg.resize(jpeg.size() - 2);  // only the end marker is gone
  expect_refusal("cut.jpg", jpeg, "is truncated or damaged (Premature end of JPEG file)");
}

TEST_F(PhotoFile, AHoleInAJpegIsRefused) {
  cv::Mat noise(480, 640, CV_8UC1);
  cv::randu(noise, 0, 255);
  std::string jpeg = encoded(".jpg", noise);
  jpeg.erase(jpeg.size() / 2, 1000);
  EXPECT_NE(error_of([&] { read("hole.jpg", jpeg); }).find("is truncated or damaged"), std::string::npos);
}

TEST_F(PhotoFile, HugePicturesAreRefusedByTheirHeader) {
  std::string png = encoded(".png", grey_picture());
  png.replace(16, 8, std::string("\0\0\xEA\x60\0\0\xEA\x60", 8));  // IHDR: 60000 x 60000
  expect_refusal("huge.png", png, "has 60000 x 60000 pixels, at most 250 million are allowed");

  std::string jpeg = encoded(".jpg", grey_picture());
  const std::size_t frame = jpeg.find(std::string("\xFF\xC0", 2));
  ASSERT_NE(frame, std::string::npos);
  jpeg.replace(frame + 5, 4, "\xEA\x60\xEA\x60");
  expect_refusal("huge.jpg", jpeg, "has 60000 x 60000 pixels, at most 250 million are allowed");

  std::string tiff = encoded(".tif", grey_picture());
  for (const std::string& tag : {std::string("\x00\x01", 2), std::string("\x01\x01", 2)})
    for (std::size_t at = tiff.find(tag); at != std::string::npos; at = tiff.find(tag, at + 1))
      if (tiff.compare(at + 4, 4, std::string("\1\0\0\0", 4)) == 0)
        tiff.replace(at + 2, 10, std::string("\4\0\1\0\0\0\x60\xEA\0\0", 10));
  expect_refusal("huge.tif", tiff, "has 60000 x 60000 pixels, at most 250 million are allowed");
}

TEST_F(PhotoFile, WhatIsNoPhoto) {
  expect_refusal("empty.jpg", "", "is empty");
  expect_refusal("notes.txt", "wind from the west", "is not a JPEG, PNG or TIFF picture");
  expect_refusal("photo.gif", "GIF89a", "is not a JPEG, PNG or TIFF picture");
  EXPECT_EQ(error_of([&] { read_photo(folder_.file("none.jpg")); }),
            "photo '" + folder_.file("none.jpg") + "': No such file or directory");
  EXPECT_EQ(error_of([&] { read_photo(folder_.path()); }), "photo '" + folder_.path() + "': Is a directory");
}

TEST_F(PhotoFile, FloatingPointIsRefused) {
  expect_refusal("float.tif", encoded(".tif", flat(CV_32FC1, 0.5)),
                 "has 32 bits of floating point, must have 8 or 16 bits, whole numbers");
}

}  // namespace
}  // namespace aeolian
