#pragma once

#include <cstddef>
#include <string>

#include "aeolian_core/measure/photo.hpp"

namespace aeolian {

/// What the EXIF data of a photo file say, as far as it matters here.
struct ExifFacts {
  int orientation = 1;          ///< 1 to 8
  double focal_35mm = 0;        ///< focal length of the same angle of view on 35 mm film [mm], 0: not known
  std::string time_of_picture;  ///< "2026:06:01 15:30:00", empty: not known
};

/// Throws Error when a header promises more pixels than read_photo takes, or none.
void check_photo_size(const std::string& path, std::size_t width, std::size_t height);

/// Decodes the luma of a JPEG file's bytes as they are stored, not yet turned upright.
Photo decode_jpeg(const std::string& path, const std::string& bytes);

/// Decodes a PNG or TIFF file's bytes, turned upright.
Photo decode_png(const std::string& path, const std::string& bytes);
Photo decode_tiff(const std::string& path, const std::string& bytes);

ExifFacts exif_of_jpeg(const std::string& bytes);
ExifFacts exif_of_tiff(const std::string& path);

}  // namespace aeolian
