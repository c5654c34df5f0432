#include "aeolian_core/measure/directional_lines.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace aeolian {
namespace {

constexpr double most_samples = 1 << 18;

/// Bilinear value at a place given in cells (0 = centre of the first); NaN outside or beside unknown cells.
/// Exact on cell centres, where `sample` would round metres and let an unknown neighbour in.
float bilinear(const GridGeometry& g, const HeightMap::Layer& values, double u, double v) {
  constexpr double rounding = 1e-9;
  if (!(u >= -rounding && v >= -rounding && u <= g.nx() - 1 + rounding && v <= g.ny() - 1 + rounding))
    return HeightMap::unknown;
  const int i = std::min(static_cast<int>(u + rounding), std::max(0, g.nx() - 2));
  const int j = std::min(static_cast<int>(v + rounding), std::max(0, g.ny() - 2));
  const double fu = u - i;
  const double fv = v - j;
  double sum = 0;
  for (int dj = 0; dj < 2; ++dj)
    for (int di = 0; di < 2; ++di) {
      const double weight = (di == 1 ? fu : 1 - fu) * (dj == 1 ? fv : 1 - fv);
      if (std::abs(weight) > rounding) sum += weight * static_cast<double>(values[g.index(i + di, j + dj)]);
    }
  return static_cast<float>(sum);
}

}  // namespace

Plane fit_plane(const GridGeometry& g, const HeightMap::Layer& elevation) {
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (int iy = 0; iy < g.ny(); ++iy) {
    double n = 0, x = 0, xx = 0, h = 0, xh = 0;  // sums over the row
    const float* row = elevation.data() + g.index(0, iy);
    for (int ix = 0; ix < g.nx(); ++ix) {
      const bool known = std::isfinite(row[ix]);
      const double place = known ? ix - 0.5 * (g.nx() - 1) : 0;
      const double height = known ? static_cast<double>(row[ix]) : 0;
      n += known ? 1 : 0;
      x += place;
      xx += place * place;
      h += height;
      xh += place * height;
    }
    const double y = iy - 0.5 * (g.ny() - 1);
    Eigen::Matrix3d of_row;
    of_row << n, x, n * y, x, xx, x * y, n * y, x * y, n * y * y;
    normal += of_row;
    right += Eigen::Vector3d(h, xh, h * y);
  }
  if (normal(0, 0) == 0) return {};
  const Eigen::ColPivHouseholderQR<Eigen::Matrix3d> solver(normal);
  if (solver.rank() < 3) return {right(0) / normal(0, 0), 0, 0};
  const Eigen::Vector3d fit = solver.solve(right);
  return {fit(0), fit(1), fit(2)};
}

DirectionalLines::DirectionalLines(const GridGeometry& g, const HeightMap::Layer& elevation,
                                   const Plane& plane, double direction) {
  const auto snapped = [](double v) { return std::abs(v) < 1e-9 ? 0 : v; };
  const double c = snapped(std::cos(direction));
  const double s = snapped(std::sin(direction));
  const auto cells = [](double extent) { return std::max(1, static_cast<int>(extent + 1e-6)); };
  length = cells(std::abs(c) * g.nx() + std::abs(s) * g.ny());
  const int across = cells(std::abs(s) * g.nx() + std::abs(c) * g.ny());
  spacing = static_cast<int>(std::ceil(static_cast<double>(across) * length / most_samples));
  count = (across + spacing - 1) / spacing;
  value.resize(start(count));
  known.resize(start(count));
  for (int line = 0; line < count; ++line) {
    const double q = line * spacing - 0.5 * (across - 1);
    for (int k = 0; k < length; ++k) {
      const double p = k - 0.5 * (length - 1);
      const double x = c * p - s * q;
      const double y = s * p + c * q;
      const float h = bilinear(g, elevation, x + 0.5 * (g.nx() - 1), y + 0.5 * (g.ny() - 1));
      if (!std::isfinite(h)) continue;
      const std::size_t at = start(line) + static_cast<std::size_t>(k);
      value[at] = static_cast<float>(static_cast<double>(h) - (plane.a + plane.b * x + plane.c * y));
      known[at] = 1;
    }
  }
}

std::optional<double> correlation(const DirectionalLines& earlier, const DirectionalLines& later, int lag) {
  const int pairs = earlier.length - std::abs(lag);
  if (pairs <= 0) return std::nullopt;
  using Line = Eigen::Map<const Eigen::ArrayXf>;
  double n = 0;
  double a = 0;
  double b = 0;
  double aa = 0;
  double bb = 0;
  double ab = 0;
  for (int line = 0; line < earlier.count; ++line) {
    const std::size_t first = earlier.start(line) + static_cast<std::size_t>(std::max(0, -lag));
    const std::size_t second = later.start(line) + static_cast<std::size_t>(std::max(0, lag));
    const Line va(earlier.value.data() + first, pairs);
    const Line ka(earlier.known.data() + first, pairs);
    const Line vb(later.value.data() + second, pairs);
    const Line kb(later.known.data() + second, pairs);
    n += static_cast<double>((ka * kb).sum());
    a += static_cast<double>((va * kb).sum());
    b += static_cast<double>((ka * vb).sum());
    aa += static_cast<double>((va * va * kb).sum());
    bb += static_cast<double>((ka * vb * vb).sum());
    ab += static_cast<double>((va * vb).sum());
  }
  if (n < 0.05 * static_cast<double>(earlier.value.size())) return std::nullopt;
  const double variance_a = aa - a * a / n;
  const double variance_b = bb - b * b / n;
  if (!(variance_a > 1e-12 * aa && variance_b > 1e-12 * bb)) return std::nullopt;
  return (ab - a * b / n) / std::sqrt(variance_a * variance_b);
}

}  // namespace aeolian
