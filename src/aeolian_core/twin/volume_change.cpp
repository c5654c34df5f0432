#include "aeolian_core/twin/volume_change.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "aeolian_core/twin/difference.hpp"

namespace aeolian {
namespace {

struct Sum {
  double cells = 0;
  double heights = 0;
  double squared_levels = 0;
};

}  // namespace

VolumeChange volume_change(const HeightMap& difference, double correlation_area, double common_sigma) {
  constexpr double levels_per_sigma = 1.96;
  const HeightMap::Layer& heights = difference.layer(layer::difference);
  const HeightMap::Layer& levels = difference.layer(layer::lod95);
  enum : std::size_t { within, gained, lost };
  std::array<Sum, 3> sums;
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const float d = heights[i];
    const float level = levels[i];
    if (!std::isfinite(d + level)) continue;
    Sum& sum = sums[d > level ? gained : -d > level ? lost : within];
    sum.cells += 1;
    sum.heights += static_cast<double>(d);
    sum.squared_levels += static_cast<double>(level) * static_cast<double>(level);
  }
  const double area = difference.geometry().cell() * difference.geometry().cell();
  const auto volume = [&](double sign, const Sum& sum) -> Figure {
    const double alike = std::min(std::max(1.0, correlation_area), std::max(1.0, sum.cells));
    const double own = std::sqrt(sum.squared_levels * alike) / levels_per_sigma;
    return {sign * area * sum.heights, area * std::hypot(own, sum.cells * common_sigma)};
  };
  Sum all;
  for (const Sum& sum : sums) {
    all.cells += sum.cells;
    all.heights += sum.heights;
    all.squared_levels += sum.squared_levels;
  }
  VolumeChange result;
  result.known_cells = static_cast<std::size_t>(all.cells);
  result.significant_cells = static_cast<std::size_t>(sums[gained].cells + sums[lost].cells);
  result.gain = volume(1, sums[gained]);
  result.loss = volume(sums[lost].cells > 0 ? -1 : 1, sums[lost]);
  result.net = volume(1, all);
  return result;
}

}  // namespace aeolian
