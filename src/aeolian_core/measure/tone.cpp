#include "aeolian_core/measure/tone.hpp"

#include <cmath>

namespace aeolian {

Tone::Tone(const Photo& photo)
    : width_(photo.width_px), height_(photo.height_px), light_(static_cast<std::size_t>(photo.white) + 1) {
  if (photo.white == 255)
    values8_ = photo.values8.data();
  else
    values16_ = photo.values16.data();
  for (std::size_t i = 0; i < light_.size(); ++i) {
    const double value = static_cast<double>(i) / photo.white;
    light_[i] = static_cast<float>(value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4));
  }
}

float Tone::operator()(double u, double v) const {
  const double left = std::floor(u);
  const double top = std::floor(v);
  const int i = static_cast<int>(left);
  const int j = static_cast<int>(top);
  const float a = static_cast<float>(u - left);
  const float b = static_cast<float>(v - top);
  const Tone& tone = *this;
  return (1 - b) * ((1 - a) * tone(i, j) + a * tone(i + 1, j)) +
         b * ((1 - a) * tone(i, j + 1) + a * tone(i + 1, j + 1));
}

}  // namespace aeolian
