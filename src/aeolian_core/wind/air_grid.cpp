#include "aeolian_core/wind/air_grid.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

/// Beyond the map on either side. A ridge without end is felt from far; where boxes are long along one axis
/// and short along the other the solver takes its time.
struct Border {
  int boxes;
  double growth;
};
constexpr Border ridge_border{8, 1.5};
constexpr Border hill_border{6, 1.25};
constexpr double height_growth = 1.15;
constexpr double reach = 6;        ///< of the air above the highest ground, in units of the relief
constexpr double aspect = 0.25;    ///< of its height, at least, and the map's length
constexpr int relief_boxes = 28;   ///< between the lowest and the highest ground
constexpr double flattest = 0.05;  ///< height of a box over its length, at least

/// Borders of n boxes of length `box` from `origin` and of those beyond.
std::vector<double> borders(double origin, double box, int n, bool thin, const Border& border) {
  std::vector<double> inner;
  for (int i = 0; i <= n; ++i) inner.push_back(origin + i * box);
  if (thin) return inner;
  std::vector<double> all;
  double length = box;
  for (int i = 0; i < border.boxes; ++i) {
    length *= border.growth;
    inner.push_back(inner.back() + length);
    all.push_back((all.empty() ? origin : all.back()) - length);
  }
  std::reverse(all.begin(), all.end());
  all.insert(all.end(), inner.begin(), inner.end());
  return all;
}

}  // namespace

AirGrid::AirGrid(const WindRelief& relief, std::size_t max_boxes)
    : relief_(relief), thin_x_(relief.geometry.nx() == 1), thin_y_(relief.geometry.ny() == 1) {
  const GridGeometry& g = relief.geometry;
  const Border& border = thin_x_ || thin_y_ ? ridge_border : hill_border;
  const auto [low, high] = std::minmax_element(relief.height.begin(), relief.height.end());
  for (double joined = 1;; joined *= 1.1) {
    const double box = joined * g.cell();
    const auto count = [&](int n) {
      return n == 1 ? 1 : std::max(2, static_cast<int>(std::lround(n / joined)));
    };
    const int nx = count(g.nx());
    const int ny = count(g.ny());
    const double box_x = g.length_x() / nx;
    const double box_y = g.length_y() / ny;
    const double tall = std::max((*high - *low) / relief_boxes, flattest * box);
    z_ = {*low - 1e-6 * tall};
    while (z_.back() < *high + tall) z_.push_back(z_.back() + tall);
    const double above =
        z_.back() + std::max(reach * (*high - *low), aspect * std::max(g.length_x(), g.length_y()));
    for (double step = tall; z_.back() < above;) z_.push_back(z_.back() + (step *= height_growth));
    x_ = borders(g.origin_x(), box_x, nx, thin_x_, border);
    y_ = borders(g.origin_y(), box_y, ny, thin_y_, border);
    if ((x_.size() - 1) * (y_.size() - 1) * (z_.size() - 1) <= max_boxes || (nx <= 2 && ny <= 2)) return;
  }
}

double AirGrid::ground(double x, double y) const {
  const GridGeometry& g = relief_.geometry;
  const double fx = std::clamp((x - g.origin_x()) / g.cell() - 0.5, 0.0, g.nx() - 1.0);
  const double fy = std::clamp((y - g.origin_y()) / g.cell() - 0.5, 0.0, g.ny() - 1.0);
  const int ix = std::min(static_cast<int>(fx), std::max(g.nx() - 2, 0));
  const int iy = std::min(static_cast<int>(fy), std::max(g.ny() - 2, 0));
  const int jx = std::min(ix + 1, g.nx() - 1);
  const int jy = std::min(iy + 1, g.ny() - 1);
  const double wx = fx - ix;
  const double wy = fy - iy;
  return (1 - wy) * ((1 - wx) * relief_.height[g.index(ix, iy)] + wx * relief_.height[g.index(jx, iy)]) +
         wy * ((1 - wx) * relief_.height[g.index(ix, jy)] + wx * relief_.height[g.index(jx, jy)]);
}

void AirGrid::western_edge(int ix, int iy, double* heights) const {
  const auto i = static_cast<std::size_t>(iy);
  for (int s = 0; s < samples; ++s)
    heights[s] = ground(x_[static_cast<std::size_t>(ix)], y_[i] + (s + 0.5) / samples * (y_[i + 1] - y_[i]));
}

void AirGrid::southern_edge(int ix, int iy, double* heights) const {
  const auto i = static_cast<std::size_t>(ix);
  for (int s = 0; s < samples; ++s)
    heights[s] = ground(x_[i] + (s + 0.5) / samples * (x_[i + 1] - x_[i]), y_[static_cast<std::size_t>(iy)]);
}

void AirGrid::footprint(int ix, int iy, double* heights) const {
  const auto i = static_cast<std::size_t>(ix);
  const auto j = static_cast<std::size_t>(iy);
  for (int t = 0; t < samples; ++t)
    for (int s = 0; s < samples; ++s)
      heights[t * samples + s] = ground(x_[i] + (s + 0.5) / samples * (x_[i + 1] - x_[i]),
                                        y_[j] + (t + 0.5) / samples * (y_[j + 1] - y_[j]));
}

double AirGrid::open(const double* heights, int iz) const {
  const double low = z_[static_cast<std::size_t>(iz)];
  const double high = z_[static_cast<std::size_t>(iz) + 1];
  double sum = 0;
  for (int s = 0; s < samples; ++s) sum += std::clamp((high - heights[s]) / (high - low), 0.0, 1.0);
  return sum / samples;
}

}  // namespace aeolian
