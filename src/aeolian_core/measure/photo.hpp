#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace aeolian {

/// A grey photograph as a viewer shows it (EXIF orientation applied), rows from the top.
struct Photo {
  int width_px = 0;
  int height_px = 0;
  int white = 255;                      ///< the largest value: 255 or 65535
  std::vector<std::uint8_t> values8;    ///< one of the two holds the picture, row by row
  std::vector<std::uint16_t> values16;  ///< when white is 65535
  /// Focal length [px] after the EXIF entry FocalLengthIn35mmFilm, where there is one.
  std::optional<double> exif_focal_px;
  /// Unix time of the EXIF entry DateTimeOriginal taken as UTC, where there is one [s].
  std::optional<double> exif_time;
};

/// Reads JPEG, PNG or TIFF: grey or colour, with or without alpha (ignored), CMYK, 8 or 16 bits; colours
/// become luma. Throws Error in one line naming the file for what is not such a picture, is truncated, or has
/// more than 250 million pixels.
Photo read_photo(const std::string& path);

}  // namespace aeolian
