#include "aeolian_core/twin/orientation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "aeolian_core/surface/thinning.hpp"
#include "aeolian_core/wind/direction.hpp"

namespace aeolian {
namespace {

constexpr std::size_t strips = 8;

/// Sums of products of slopes.
struct Tensor {
  double xx = 0, xy = 0, yy = 0;

  void add(const Tensor& other, double sign) {
    xx += sign * other.xx;
    xy += sign * other.xy;
    yy += sign * other.yy;
  }
  double angle() const { return 0.5 * std::atan2(2 * xy, xx - yy); }
  /// 0: as steep in every direction, 1: in one only.
  double coherence() const { return std::hypot(xx - yy, 2 * xy) / (xx + yy); }
};

/// An angle that is known up to half a turn, nearest to another.
double nearest_to(double angle, double other) { return other + std::remainder(angle - other, M_PI); }

}  // namespace

Figure crest_normal(const GridGeometry& geometry, const HeightMap::Layer& elevation, double wavelength,
                    double direction) {
  constexpr double cells_of_wavelength = 20;
  constexpr double least_coherence = 0.1;
  if (!std::isfinite(wavelength) || std::min(geometry.nx(), geometry.ny()) < 4) return {NAN, NAN};
  const int factor = std::clamp(static_cast<int>(wavelength / geometry.cell() / cells_of_wavelength), 1,
                                std::min(geometry.nx(), geometry.ny()) / 4);
  const GridGeometry grid = thinned(geometry, factor);
  HeightMap::Layer z(grid.size());
  thin(geometry, elevation, factor, {0, grid.nx(), 0, grid.ny()}, z);

  const bool along_x = grid.nx() >= grid.ny();
  std::array<Tensor, strips> of_strip;
  // Central differences over five cells: exact to fourth order, so that oblique waves are not turned.
  const auto slope = [&](std::size_t at, std::size_t stride) {
    return (8 * (z[at + stride] - z[at - stride]) - (z[at + 2 * stride] - z[at - 2 * stride])) / 12;
  };
  for (int y = 2; y + 2 < grid.ny(); ++y)
    for (int x = 2; x + 2 < grid.nx(); ++x) {
      const std::size_t at = grid.index(x, y);
      const auto sx = static_cast<double>(slope(at, 1));
      const auto sy = static_cast<double>(slope(at, static_cast<std::size_t>(grid.nx())));
      if (!std::isfinite(sx + sy)) continue;
      const int place =
          along_x ? x * static_cast<int>(strips) / grid.nx() : y * static_cast<int>(strips) / grid.ny();
      of_strip[static_cast<std::size_t>(place)].add({sx * sx, sx * sy, sy * sy}, 1);
    }
  Tensor total;
  for (const Tensor& strip : of_strip) total.add(strip, 1);
  if (!(total.coherence() >= least_coherence)) return {NAN, NAN};
  const double angle = nearest_to(total.angle(), direction);
  double sum = 0;
  double squares = 0;
  for (const Tensor& strip : of_strip) {
    Tensor rest = total;
    rest.add(strip, -1);
    const double off = nearest_to(rest.angle(), angle) - angle;
    sum += off;
    squares += off * off;
  }
  const double variance = (strips - 1.0) / strips * (squares - sum * sum / strips);
  return {wrap_angle(angle), std::sqrt(std::max(0.0, variance))};
}

}  // namespace aeolian
