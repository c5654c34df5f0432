// PNG and TIFF through OpenCV, which turns them upright; their headers are looked at first, so that a huge or
// truncated file costs nothing.

#include <cstdint>
#include <memory>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <tiffio.h>

#include "aeolian_core/measure/photo_formats.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw Error("photo '" + path + "': " + reason);
}

Photo decode(const std::string& path, const std::string& bytes) {
  cv::Mat picture;
  try {
    const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1, const_cast<char*>(bytes.data()));
    picture = cv::imdecode(encoded, cv::IMREAD_ANYCOLOR | cv::IMREAD_ANYDEPTH);
    if (picture.channels() == 3) cv::cvtColor(picture, picture, cv::COLOR_BGR2GRAY);
  } catch (const cv::Exception& error) {
    refuse(path, "cannot be decoded: " + error.err);
  }
  if (picture.empty()) refuse(path, "is truncated or damaged");
  Photo photo;
  photo.width_px = picture.cols;
  photo.height_px = picture.rows;
  if (picture.depth() == CV_8U) {
    photo.values8.assign(picture.begin<std::uint8_t>(), picture.end<std::uint8_t>());
  } else if (picture.depth() == CV_16U) {
    photo.white = 65535;
    photo.values16.assign(picture.begin<std::uint16_t>(), picture.end<std::uint16_t>());
  } else {
    refuse(path, "must have 8 or 16 bits");
  }
  return photo;
}

std::size_t big_endian(const std::string& bytes, std::size_t at) {
  std::size_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

/// Whether the chunks of a PNG file run up to its end chunk.
bool complete_png(const std::string& bytes) {
  constexpr std::size_t around = 12;  // length, type and checksum
  for (std::size_t at = 8; at + around <= bytes.size();) {
    const std::size_t end = at + around + big_endian(bytes, at);
    if (end > bytes.size()) return false;
    if (bytes.compare(at + 4, 4, "IEND") == 0) return true;
    at = end;
  }
  return false;
}

using Tiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

Tiff open_tiff(const std::string& path) {
  TIFFSetErrorHandler(nullptr);  // what it would print is told in an Error
  TIFFSetWarningHandler(nullptr);
  return {TIFFOpen(path.c_str(), "rM"), TIFFClose};
}

}  // namespace

Photo decode_png(const std::string& path, const std::string& bytes) {
  constexpr std::size_t header_end = 33;
  if (bytes.size() < header_end || bytes.compare(12, 4, "IHDR") != 0) refuse(path, "is truncated or damaged");
  check_photo_size(path, big_endian(bytes, 16), big_endian(bytes, 20));
  if (!complete_png(bytes)) refuse(path, "is truncated or damaged");
  return decode(path, bytes);
}

Photo decode_tiff(const std::string& path, const std::string& bytes) {
  const Tiff tiff = open_tiff(path);
  if (!tiff) refuse(path, "is truncated or damaged");
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  check_photo_size(path, width, height);
  std::uint16_t bits = 0;
  std::uint16_t format = 0;
  std::uint16_t samples = 0;
  std::uint16_t planes = 0;
  std::uint16_t colours = 0;
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLEFORMAT, &format);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, &samples);
  TIFFGetFieldDefaulted(tiff.get(), TIFFTAG_PLANARCONFIG, &planes);
  TIFFGetField(tiff.get(), TIFFTAG_PHOTOMETRIC, &colours);
  if (bits > 16 || (format != SAMPLEFORMAT_UINT && format != SAMPLEFORMAT_VOID))
    refuse(path, fmt::format("has {} bits{}, must have 8 or 16 bits, whole numbers", bits,
                             format == SAMPLEFORMAT_IEEEFP ? " of floating point" : ""));
  // OpenCV takes the values of 16-bit files as they lie.
  const bool plain = (colours == PHOTOMETRIC_MINISBLACK && samples == 1) ||
                     (colours == PHOTOMETRIC_RGB && (samples == 3 || samples == 4));
  if (bits == 16 && !(plain && (samples == 1 || planes == PLANARCONFIG_CONTIG)))
    refuse(path, "as a TIFF of 16 bits must be grey with black at 0, or RGB in one plane");
  return decode(path, bytes);
}

ExifFacts exif_of_tiff(const std::string& path) {
  ExifFacts facts;
  const Tiff tiff = open_tiff(path);
  toff_t place = 0;
  if (!tiff || TIFFGetField(tiff.get(), TIFFTAG_EXIFIFD, &place) == 0 ||
      TIFFReadEXIFDirectory(tiff.get(), place) == 0)
    return facts;
  std::uint16_t focal = 0;
  char* time = nullptr;
  if (TIFFGetField(tiff.get(), EXIFTAG_FOCALLENGTHIN35MMFILM, &focal) == 1) facts.focal_35mm = focal;
  if (TIFFGetField(tiff.get(), EXIFTAG_DATETIMEORIGINAL, &time) == 1 && time != nullptr)
    facts.time_of_picture = time;
  return facts;
}

}  // namespace aeolian
