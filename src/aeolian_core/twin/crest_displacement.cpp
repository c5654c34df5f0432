#include "aeolian_core/twin/crest_displacement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "aeolian_core/surface/kernel.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

/// Sums over pairs of known samples.
struct Sums {
  float n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;

  void add(const Sums& other) {
    n += other.n;
    a += other.a;
    b += other.b;
    aa += other.aa;
    bb += other.bb;
    ab += other.ab;
  }
  double correlation() const {
    const double count = static_cast<double>(n);
    const double mean_a = static_cast<double>(a) / count;
    const double mean_b = static_cast<double>(b) / count;
    const double variance_a = static_cast<double>(aa) / count - mean_a * mean_a;
    const double variance_b = static_cast<double>(bb) / count - mean_b * mean_b;
    return (static_cast<double>(ab) / count - mean_a * mean_b) / std::sqrt(variance_a * variance_b);
  }
};

/// Side by side, so that vectors can add them.
AEOLIAN_KERNEL Sums sums_of(const float* __restrict a, const float* __restrict known_a,
                            const float* __restrict b, const float* __restrict known_b, int count) {
  constexpr int lanes = 8;
  float n[lanes] = {}, sa[lanes] = {}, sb[lanes] = {}, aa[lanes] = {}, bb[lanes] = {}, ab[lanes] = {};
  const auto take = [&](int i, int lane) __attribute__((always_inline)) {
    const float va = a[i] * known_b[i];
    const float vb = b[i] * known_a[i];
    n[lane] += known_a[i] * known_b[i];
    sa[lane] += va;
    sb[lane] += vb;
    aa[lane] += va * va;
    bb[lane] += vb * vb;
    ab[lane] += va * vb;
  };
  int i = 0;
  for (; i + lanes <= count; i += lanes)
    for (int lane = 0; lane < lanes; ++lane) take(i + lane, lane);
  for (int lane = 0; i + lane < count; ++lane) take(i + lane, lane);
  Sums result;
  for (int lane = 0; lane < lanes; ++lane) {
    result.n += n[lane];
    result.a += sa[lane];
    result.b += sb[lane];
    result.aa += aa[lane];
    result.bb += bb[lane];
    result.ab += ab[lane];
  }
  return result;
}

/// Tiles of a wavelength; a window is two by two of them.
struct Tiles {
  int side;    ///< samples along
  int lines;   ///< across
  int across;  ///< their number along the lines
  int up;

  Tiles(const DirectionalLines& of, double samples)
      : side(std::max(1, static_cast<int>(std::lround(samples)))),
        lines(std::clamp(static_cast<int>(std::lround(samples / of.spacing)), 1, std::max(1, of.count / 2))),
        across(of.length / side),
        up(std::max(1, of.count / lines)) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(across) + static_cast<std::size_t>(x);
  }
};

/// Sums of each tile of the earlier lines against the later ones at a lag.
std::vector<Sums> tile_sums(const DirectionalLines& a, const DirectionalLines& b, const Tiles& tiles,
                            int lag) {
  std::vector<Sums> result(tiles.index(0, tiles.up));
  for (int line = 0; line < tiles.up * tiles.lines && line < a.count; ++line)
    for (int x = 0; x < tiles.across; ++x) {
      const int first = std::max(x * tiles.side, -lag);
      const int last = std::min((x + 1) * tiles.side, a.length - lag);
      if (first >= last) continue;
      const std::size_t at_a = a.start(line) + static_cast<std::size_t>(first);
      const std::size_t at_b = b.start(line) + static_cast<std::size_t>(first + lag);
      result[tiles.index(x, line / tiles.lines)].add(
          sums_of(&a.value[at_a], &a.known[at_a], &b.value[at_b], &b.known[at_b], last - first));
    }
  return result;
}

}  // namespace

CrestDisplacement crest_displacement(const DirectionalLines& earlier, const DirectionalLines& later,
                                     double cell, double wavelength) {
  CrestDisplacement field;
  field.median = field.spread = NAN;
  const double samples = wavelength / cell;
  if (!std::isfinite(samples) || samples < 4 || 2 * samples > earlier.length) return field;
  constexpr double weakest = 0.5;
  constexpr int steps_of_half = 8;
  const Tiles tiles(earlier, samples);
  field.across = std::max(0, tiles.across - 1);
  field.up = std::max(1, tiles.up - 1);
  field.hop = tiles.side * cell;
  field.hop_across = tiles.lines * earlier.spacing * cell;
  const int high = tiles.up > 1 ? 2 : 1;
  const int step = std::max(1, static_cast<int>(std::lround(samples / 2 / steps_of_half)));
  const int steps = static_cast<int>(std::ceil(samples / 2 / step)) + 1;
  const auto windows = static_cast<std::size_t>(field.across) * static_cast<std::size_t>(field.up);
  const double enough = 0.5 * tiles.side * tiles.lines * high;
  std::vector<std::vector<double>> curves(windows);
  for (int i = -steps; i <= steps; ++i) {
    const std::vector<Sums> sums = tile_sums(earlier, later, tiles, i * step);
    for (int y = 0; y < field.up; ++y)
      for (int x = 0; x < field.across; ++x) {
        Sums window;
        for (int dy = 0; dy < high; ++dy)
          for (int dx = 0; dx < 2; ++dx) window.add(sums[tiles.index(x + dx, y + dy)]);
        curves[static_cast<std::size_t>(y) * static_cast<std::size_t>(field.across) +
               static_cast<std::size_t>(x)]
            .push_back(static_cast<double>(window.n) < enough ? NAN : window.correlation());
      }
  }
  std::vector<double> found;
  for (const std::vector<double>& curve : curves) {
    double best = weakest;
    double place = NAN;
    for (std::size_t i = 1; i + 1 < curve.size(); ++i) {
      if (!(curve[i] > best && curve[i] >= curve[i - 1] && curve[i] > curve[i + 1])) continue;
      best = curve[i];
      const double bend = curve[i - 1] - 2 * curve[i] + curve[i + 1];
      place = static_cast<double>(i) - steps + 0.5 * (curve[i - 1] - curve[i + 1]) / bend;
    }
    field.displacement.push_back(place * step * cell);
    if (std::isfinite(place)) found.push_back(field.displacement.back());
  }
  field.median = median(found);
  for (double& value : found) value = std::abs(value - field.median);
  field.spread = sigma_per_median * median(found);
  return field;
}

HeightMap::Layer displacement_layer(const CrestDisplacement& field, const GridGeometry& g, double direction) {
  HeightMap::Layer result(g.size(), HeightMap::unknown);
  if (field.displacement.empty()) return result;
  const double c = std::cos(direction);
  const double s = std::sin(direction);
  const double length = std::abs(c) * g.length_x() + std::abs(s) * g.length_y();
  const double width = std::abs(s) * g.length_x() + std::abs(c) * g.length_y();
  for (int y = 0; y < g.ny(); ++y)
    for (int x = 0; x < g.nx(); ++x) {
      const double px = (x - 0.5 * (g.nx() - 1)) * g.cell();
      const double py = (y - 0.5 * (g.ny() - 1)) * g.cell();
      const int i = static_cast<int>(std::floor((c * px + s * py + length / 2) / field.hop - 0.5));
      const int j =
          field.up == 1
              ? 0
              : static_cast<int>(std::floor((c * py - s * px + width / 2) / field.hop_across - 0.5));
      if (i < -1 || i > field.across || j < -1 || j > field.up) continue;
      const int near_i = std::clamp(i, 0, field.across - 1);
      const int near_j = std::clamp(j, 0, field.up - 1);
      result[g.index(x, y)] = static_cast<float>(
          field.displacement[static_cast<std::size_t>(near_j) * static_cast<std::size_t>(field.across) +
                             static_cast<std::size_t>(near_i)]);
    }
  return result;
}

}  // namespace aeolian
