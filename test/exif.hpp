#pragma once

#include <cstdint>
#include <string>

namespace aeolian {

/// A JPEG's bytes with an EXIF segment before the rest, little-endian, after the EXIF standard 2.3.
/// `time` as cameras write it: "2026:06:01 15:30:00".
inline std::string with_exif(const std::string& jpeg, int orientation, int focal_35mm,
                             const std::string& time) {
  const auto append = [](std::string& to, std::size_t value, int count) {
    for (int i = 0; i < count; ++i) to += static_cast<char>(value >> (8 * i) & 0xFF);
  };
  const auto entry = [&](std::string& to, std::size_t tag, std::size_t type, std::size_t count,
                         std::size_t value) {
    append(to, tag, 2);
    append(to, type, 2);
    append(to, count, 4);
    append(to, value, 4);
  };
  constexpr std::size_t directory = 2 + 2 * 12 + 4;  // of two entries
  std::string tiff("II*\0\x08\0\0\0", 8);
  append(tiff, 2, 2);
  entry(tiff, 0x0112, 3, 1, static_cast<std::size_t>(orientation));
  entry(tiff, 0x8769, 4, 1, 8 + directory);
  append(tiff, 0, 4);
  append(tiff, 2, 2);
  entry(tiff, 0x9003, 2, time.size() + 1, 8 + 2 * directory);
  entry(tiff, 0xA405, 3, 1, static_cast<std::size_t>(focal_35mm));
  append(tiff, 0, 4);
  tiff += time + '\0';
  const std::string payload = std::string("Exif\0\0", 6) + tiff;
  std::string segment = "\xFF\xE1";
  segment += static_cast<char>((payload.size() + 2) >> 8);
  segment += static_cast<char>((payload.size() + 2) & 0xFF);
  return jpeg.substr(0, 2) + segment + payload + jpeg.substr(2);
}

}  // namespace aeolian
