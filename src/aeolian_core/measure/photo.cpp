#include "aeolian_core/measure/photo.hpp"

#include <cmath>

#include <fmt/format.h>
#include <opencv2/core.hpp>

#include "aeolian_core/measure/photo_formats.hpp"
#include "aeolian_core/measure/sun_position.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/text.hpp"

namespace aeolian {
namespace {

bool starts_with(const std::string& bytes, std::string_view signature) {
  return std::string_view(bytes).substr(0, signature.size()) == signature;
}

cv::Mat upright(const cv::Mat& stored, int orientation) {
  constexpr int upside_down = 0;
  constexpr int left_to_right = 1;
  constexpr int both = -1;
  cv::Mat turned = stored;
  if (orientation >= 5) cv::transpose(stored, turned);
  cv::Mat result;
  switch (orientation) {
    case 2:
    case 6:
      cv::flip(turned, result, left_to_right);
      return result;
    case 3:
    case 7:
      cv::flip(turned, result, both);
      return result;
    case 4:
    case 8:
      cv::flip(turned, result, upside_down);
      return result;
    default:
      return turned;
  }
}

void turn_upright(Photo& photo, int orientation) {
  if (orientation <= 1 || orientation > 8) return;
  const cv::Mat result =
      upright(cv::Mat(photo.height_px, photo.width_px, CV_8UC1, photo.values8.data()), orientation);
  photo.values8.assign(result.datastart, result.dataend);
  photo.width_px = result.cols;
  photo.height_px = result.rows;
}

/// The 35 mm equivalent compares diagonals (CIPA DCG-001): that of 36 mm x 24 mm film.
double focal_px(double focal_35mm, const Photo& photo) {
  return focal_35mm / std::hypot(36.0, 24.0) * std::hypot(photo.width_px, photo.height_px);
}

/// Cameras without a clock write blanks or zeros, which are no time.
std::optional<double> time_of(const std::string& exif) {
  if (exif.size() < 19) return std::nullopt;
  std::string iso = exif.substr(0, 19);
  iso[4] = iso[7] = '-';
  iso[10] = 'T';
  try {
    return parse_utc(iso);
  } catch (const Error&) {
    return std::nullopt;
  }
}

}  // namespace

void check_photo_size(const std::string& path, std::size_t width, std::size_t height) {
  constexpr std::size_t side_limit = 1 << 20;
  constexpr std::size_t pixel_limit = 250'000'000;
  if (width == 0 || height == 0)
    throw Error(fmt::format("photo '{}': has {} x {} pixels", path, width, height));
  if (width > side_limit || height > side_limit || width * height > pixel_limit)
    throw Error(
        fmt::format("photo '{}': has {} x {} pixels, at most 250 million are allowed", path, width, height));
}

Photo read_photo(const std::string& path) {
  const std::string bytes = read_text(path, "photo");
  if (bytes.empty()) throw Error("photo '" + path + "': is empty");
  Photo photo;
  ExifFacts exif;
  if (starts_with(bytes, "\xFF\xD8\xFF")) {
    photo = decode_jpeg(path, bytes);
    exif = exif_of_jpeg(bytes);
    turn_upright(photo, exif.orientation);
  } else if (starts_with(bytes, "\x89PNG\r\n\x1A\n")) {
    photo = decode_png(path, bytes);
  } else if (starts_with(bytes, std::string_view("II*\0", 4)) ||
             starts_with(bytes, std::string_view("MM\0*", 4))) {
    photo = decode_tiff(path, bytes);
    exif = exif_of_tiff(path);
  } else {
    throw Error("photo '" + path + "': is not a JPEG, PNG or TIFF picture");
  }
  if (exif.focal_35mm > 0) photo.exif_focal_px = focal_px(exif.focal_35mm, photo);
  photo.exif_time = time_of(exif.time_of_picture);
  return photo;
}

}  // namespace aeolian
