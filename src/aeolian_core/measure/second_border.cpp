#include "aeolian_core/measure/second_border.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr double zone = 1e-3;          // over which light is averaged across the border [m]
constexpr double search_reach = 8e-3;  // so far from the border is looked [m]
constexpr double different = 0.3;      // of the step from dark to lit
constexpr double edge_px = 3;          // beside the bright bar, not looked at
constexpr std::size_t stations = 300;
constexpr int neighbours = 4;  // on either side, averaged against grains

/// Light of zones going away from a border: mean over the zone's rows.
struct Ladder {
  std::vector<double> inside, outside;  // nearest first; inside may be shorter, it ends at the bar
};

Ladder climb(const Tone& tone, const PhotoGeometry& geometry, const Eigen::Vector2d& border, int side,
             double gap, double pixel_size) {
  Ladder ladder;
  const int rows = std::max(1, static_cast<int>(zone / pixel_size + 0.5));
  const int zones = static_cast<int>(search_reach / (rows * pixel_size));
  const double y = side * border.y();
  const auto mean = [&](double from, double direction) {
    double sum = 0;
    for (int r = 0; r < rows; ++r) {
      const Eigen::Vector2d p = geometry.pixel(border.x(), side * (y + direction * (from + r * pixel_size)));
      sum += static_cast<double>(tone(p.x(), p.y()));
    }
    return sum / rows;
  };
  for (int z = 0; z < zones; ++z) {
    const double from = gap + z * rows * pixel_size;
    if (y - from - rows * pixel_size > edge_px * pixel_size) ladder.inside.push_back(mean(from, -1));
    ladder.outside.push_back(mean(from, 1));
  }
  return ladder;
}

/// Means over neighbouring ladders, rung by rung.
Ladder mean_of(const std::vector<Ladder>& ladders, std::size_t begin, std::size_t end) {
  Ladder mean;
  const auto add = [&](std::vector<double> Ladder::*rungs) {
    std::size_t shortest = (ladders[begin].*rungs).size();
    for (std::size_t k = begin; k < end; ++k) shortest = std::min(shortest, (ladders[k].*rungs).size());
    for (std::size_t z = 0; z < shortest; ++z) {
      double sum = 0;
      for (std::size_t k = begin; k < end; ++k) sum += (ladders[k].*rungs)[z];
      (mean.*rungs).push_back(sum / static_cast<double>(end - begin));
    }
  };
  add(&Ladder::inside);
  add(&Ladder::outside);
  return mean;
}

}  // namespace

double share_with_second_border(const Tone& tone, const PhotoGeometry& geometry,
                                const std::vector<Eigen::Vector2d>& terminus, int side, double gap,
                                double pixel_size) {
  std::vector<Ladder> ladders;
  const std::size_t stride = std::max<std::size_t>(1, terminus.size() / stations);
  for (std::size_t i = 0; i < terminus.size(); i += stride)
    ladders.push_back(climb(tone, geometry, geometry.top_face(terminus[i]), side, gap, pixel_size));
  int seen = 0;
  int doubled = 0;
  for (std::size_t k = neighbours; k + neighbours < ladders.size(); ++k) {
    const Ladder mean = mean_of(ladders, k - neighbours, k + neighbours + 1);
    if (mean.inside.empty() || mean.outside.size() < 3) continue;
    const double dark = *std::min_element(mean.inside.begin(), mean.inside.end());
    double lit = 0;
    for (std::size_t z = mean.outside.size() / 2; z < mean.outside.size(); ++z)
      lit += mean.outside[z] / static_cast<double>(mean.outside.size() - mean.outside.size() / 2);
    ++seen;
    if (mean.inside.front() - dark > different * (lit - dark) ||
        lit - mean.outside.front() > different * (lit - dark))
      ++doubled;
  }
  return seen > 0 ? static_cast<double>(doubled) / seen : 0;
}

}  // namespace aeolian
