#include "aeolian_core/measure/edge_light.hpp"

#include <algorithm>
#include <vector>

namespace aeolian {

double shaded_share_of_edge(const Tone& tone, const PhotoGeometry& geometry, const EdgeSpan& span, int side) {
  constexpr int stations = 400;
  std::vector<float> light;
  for (int i = 0; i < stations; ++i) {
    const double x = span.from + (i + 0.5) / stations * (span.to - span.from);
    float sum = 0;
    for (const double y : {0.4e-3, 0.7e-3, 1.0e-3}) {
      const Eigen::Vector2d p = geometry.pixel(x, -side * y);
      sum += tone(p.x(), p.y()) / 3;
    }
    light.push_back(sum);
  }
  std::vector<float> sorted = light;
  const auto bright = sorted.begin() + stations * 8 / 10;
  std::nth_element(sorted.begin(), bright, sorted.end());
  const float limit = *bright / 3;
  const auto shaded = std::count_if(light.begin(), light.end(), [&](float value) { return value < limit; });
  return static_cast<double>(shaded) / stations;
}

}  // namespace aeolian
