#pragma once

#include <cstddef>
#include <vector>

#include "aeolian_core/measure/photo.hpp"

namespace aeolian {

/// Linear light of a photo's values: the sRGB curve of IEC 61966-2-1 undone, 0 to 1. A shadow's end is where
/// half of the light is there, not half of the grey.
class Tone {
 public:
  explicit Tone(const Photo& photo);

  /// Light of the pixel in column u of row v; the nearest pixel's beyond the borders.
  float operator()(int u, int v) const {
    const int column = u < 0 ? 0 : u >= width_ ? width_ - 1 : u;
    const int row = v < 0 ? 0 : v >= height_ ? height_ - 1 : v;
    const std::size_t at =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(column);
    return values8_ != nullptr ? light_[values8_[at]] : light_[values16_[at]];
  }
  /// The same between pixels, bilinear.
  float operator()(double u, double v) const;

 private:
  int width_;
  int height_;
  const std::uint8_t* values8_ = nullptr;
  const std::uint16_t* values16_ = nullptr;
  std::vector<float> light_;
};

}  // namespace aeolian
