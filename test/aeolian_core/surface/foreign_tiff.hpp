#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace aeolian {

/// A GeoTIFF as another program would write it, byte by byte after the TIFF 6.0 and GeoTIFF 1.0
/// specifications: signed 16-bit heights, the first row in the north, no-data value -9999.
struct ForeignTiff {
  std::uint16_t width = 3;
  std::uint16_t height = 2;
  std::vector<std::int16_t> values;
  double west = 500000;
  double north = 5400000;
  double cell_x = 10;
  double cell_y = 10;
  std::uint16_t model = 1;  ///< 1 projected, 2 geographic
  bool georeferenced = true;

  std::string bytes() const {
    std::vector<Tag> tags;
    tags.push_back(shorts(256, {width}));
    tags.push_back(shorts(257, {height}));
    tags.push_back(shorts(258, {16}));  // bits
    tags.push_back(shorts(259, {1}));   // not compressed
    tags.push_back(shorts(262, {1}));   // black is zero
    tags.push_back(shorts(273, {8}));   // the strip follows the file's header
    tags.push_back(shorts(277, {1}));   // one sample
    tags.push_back(shorts(278, {height}));
    tags.push_back(shorts(279, {static_cast<std::uint16_t>(values.size() * 2)}));
    tags.push_back(shorts(339, {2}));  // signed
    if (georeferenced) {
      tags.push_back(doubles(33550, {cell_x, cell_y, 0}));
      tags.push_back(doubles(33922, {0, 0, 0, west, north, 0}));
      tags.push_back(shorts(
          34735, model == 1 ? std::vector<std::uint16_t>{1, 1, 0, 2, 1024, 0, 1, 1, 3072, 0, 1, 32632}
                            : std::vector<std::uint16_t>{1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4326}));
    }
    tags.push_back({42113, 2, 6, std::string("-9999\0", 6)});

    std::string file("II*\0", 4);
    const std::string pixels(reinterpret_cast<const char*>(values.data()), values.size() * 2);
    const auto directory = static_cast<std::uint32_t>(8 + pixels.size());
    put(file, directory);
    file += pixels;
    put(file, static_cast<std::uint16_t>(tags.size()));
    std::string behind;
    const auto behind_at = static_cast<std::uint32_t>(directory + 2 + 12 * tags.size() + 4);
    for (Tag& tag : tags) {
      put(file, tag.id);
      put(file, tag.type);
      put(file, tag.count);
      if (tag.data.size() > 4) {
        put(file, static_cast<std::uint32_t>(behind_at + behind.size()));
        behind += tag.data;
      } else {
        tag.data.resize(4);
        file += tag.data;
      }
    }
    put(file, std::uint32_t{0});
    return file + behind;
  }

 private:
  struct Tag {
    std::uint16_t id;
    std::uint16_t type;
    std::uint32_t count;
    std::string data;
  };
  template <class Number>
  static void put(std::string& text, Number value) {
    char raw[sizeof(Number)];
    std::memcpy(raw, &value, sizeof(Number));
    text.append(raw, sizeof(Number));
  }
  template <class Number>
  static Tag tag(std::uint16_t id, std::uint16_t type, const std::vector<Number>& numbers) {
    Tag result{id, type, static_cast<std::uint32_t>(numbers.size()), {}};
    for (const Number value : numbers) put(result.data, value);
    return result;
  }
  static Tag shorts(std::uint16_t id, const std::vector<std::uint16_t>& numbers) {
    return tag(id, 3, numbers);
  }
  static Tag doubles(std::uint16_t id, const std::vector<double>& numbers) { return tag(id, 12, numbers); }
};

}  // namespace aeolian
