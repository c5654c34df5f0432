#include "aeolian_core/measure/ripple_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "aeolian_core/measure/directional_lines.hpp"
#include "aeolian_core/measure/none.hpp"
#include "aeolian_core/surface/error.hpp"
#include "aeolian_core/surface/median.hpp"

namespace aeolian {
namespace {

/// Offset of the top of the parabola through three equidistant values, in steps from the middle one.
double parabola_top(double before, double middle, double after) {
  const double curvature = before - 2 * middle + after;
  return curvature < 0 ? 0.5 * (before - after) / curvature : 0;
}

/// The first maximum of the autocorrelation after its first minimum, in samples; NaN when there is none.
double find_wavelength(const DirectionalLines& lines) {
  // A turn counts once the correlation has come back by this much: smaller ones are the estimate's own
  // jitter.
  constexpr double turn = 0.02;
  constexpr double weakest = 0.1;
  std::vector<double> curve{1};
  double lowest = 1;
  int top = -1;
  for (int lag = 1; lag <= lines.length / 2 + 1; ++lag) {
    const auto value = correlation(lines, lines, lag);
    if (!value) return none;
    curve.push_back(*value);
    if (top < 0) {
      lowest = std::min(lowest, *value);
      if (*value > lowest + turn) top = lag;
    } else if (*value > curve[static_cast<std::size_t>(top)]) {
      top = lag;
    } else if (*value < curve[static_cast<std::size_t>(top)] - turn) {
      const auto at = static_cast<std::size_t>(top);
      if (curve[at] < weakest) return none;
      return top + parabola_top(curve[at - 1], curve[at], curve[at + 1]);
    }
  }
  return none;
}

/// Share of the variance between 2/3 and 3/2 of the wave number of a wavelength [samples], from the
/// periodogram of each line (Parseval: 2 |A_j|^2 / n over all j sums to the sum of squares).
double spectral_share(const DirectionalLines& lines, double wavelength) {
  const int n = lines.length;
  const int lowest = std::max(1, static_cast<int>(std::ceil(n / wavelength * 2 / 3)));
  const int highest = std::min((n - 1) / 2, static_cast<int>(std::floor(n / wavelength * 3 / 2)));
  double total = 0;
  for (const float v : lines.value) total += static_cast<double>(v) * static_cast<double>(v);
  double peak = 0;
  std::vector<double> cosine(static_cast<std::size_t>(n));
  std::vector<double> sine(static_cast<std::size_t>(n));
  for (int j = lowest; j <= highest; ++j) {
    for (int k = 0; k < n; ++k) {
      cosine[static_cast<std::size_t>(k)] = std::cos(2 * M_PI * j * k / n);
      sine[static_cast<std::size_t>(k)] = std::sin(2 * M_PI * j * k / n);
    }
    for (int line = 0; line < lines.count; ++line) {
      const float* value = lines.value.data() + lines.start(line);
      double real = 0;
      double imaginary = 0;
      for (std::size_t k = 0; k < cosine.size(); ++k) {
        real += static_cast<double>(value[k]) * cosine[k];
        imaginary += static_cast<double>(value[k]) * sine[k];
      }
      peak += 2 * (real * real + imaginary * imaginary) / n;
    }
  }
  return std::min(1.0, peak / total);
}

/// Slopes along the lines, each the least-squares line through a tenth of a wavelength (at least three
/// samples): shorter than a slip face, long enough to quieten noise.
void find_slopes(const DirectionalLines& lines, double cell, double wavelength, RippleStatistics& result) {
  const int half = std::max(1, static_cast<int>(wavelength / 20));
  double norm = 0;
  for (int k = -half; k <= half; ++k) norm += k * k;
  std::vector<double> rising;
  std::vector<double> falling;
  for (int line = 0; line < lines.count; ++line) {
    const float* value = lines.value.data() + lines.start(line);
    const float* known = lines.known.data() + lines.start(line);
    for (int i = half; i + half < lines.length; ++i) {
      if (std::any_of(known + i - half, known + i + half + 1, [](float k) { return k == 0; })) continue;
      double slope = 0;
      for (int k = -half; k <= half; ++k) slope += k * static_cast<double>(value[i + k]);
      slope /= norm * cell;
      (slope > 0 ? rising : falling).push_back(slope);
    }
  }
  result.stoss_slope = std::atan(median(rising));
  result.lee_slope = -std::atan(median(falling));
}

void check_sizes(const GridGeometry& geometry, const HeightMap::Layer& elevation, double direction) {
  if (elevation.size() != geometry.size())
    throw Error("ripple statistics: " + std::to_string(elevation.size()) + " heights for " +
                std::to_string(geometry.size()) + " cells");
  if (!std::isfinite(direction)) throw Error("ripple statistics: the direction is not finite");
}

}  // namespace

RippleStatistics ripple_statistics(const GridGeometry& geometry, const HeightMap::Layer& elevation,
                                   double direction) {
  check_sizes(geometry, elevation, direction);
  RippleStatistics result{none, none, none, none, none, none};
  const Plane plane = fit_plane(geometry, elevation);
  const DirectionalLines lines(geometry, elevation, plane, direction);
  const double wavelength = find_wavelength(lines);
  if (!std::isfinite(wavelength)) return result;

  double squares = 0;
  std::size_t known = 0;
  for (std::size_t i = 0; i < elevation.size(); ++i) {
    if (!std::isfinite(elevation[i])) continue;
    const CellIndex at = geometry.cell_at(i);
    const double level =
        plane.a + plane.b * (at.x - 0.5 * (geometry.nx() - 1)) + plane.c * (at.y - 0.5 * (geometry.ny() - 1));
    const double above = static_cast<double>(elevation[i]) - level;
    squares += above * above;
    ++known;
  }
  result.wavelength = wavelength * geometry.cell();
  result.height = 2 * std::sqrt(2 * squares / static_cast<double>(known));
  result.index = result.wavelength / result.height;
  result.significance = spectral_share(lines, wavelength);
  find_slopes(lines, geometry.cell(), wavelength, result);
  return result;
}

std::optional<double> pattern_displacement(const GridGeometry& geometry, const HeightMap::Layer& earlier,
                                           const HeightMap::Layer& later, double direction,
                                           double max_shift) {
  check_sizes(geometry, earlier, direction);
  check_sizes(geometry, later, direction);
  if (!(max_shift > 0))
    throw Error("pattern displacement: max_shift is " + std::to_string(max_shift) + " m, must be positive");
  constexpr double weakest = 0.2;
  constexpr double equal = 0.01;

  // The same plane is taken off both: two fits would differ with the phase of the pattern and pull its
  // maximum.
  const Plane first = fit_plane(geometry, earlier);
  const Plane second = fit_plane(geometry, later);
  const Plane common{0.5 * (first.a + second.a), 0.5 * (first.b + second.b), 0.5 * (first.c + second.c)};
  const DirectionalLines a(geometry, earlier, common, direction);
  const DirectionalLines b(geometry, later, common, direction);
  const int most = std::min(static_cast<int>(std::min(max_shift / geometry.cell(), 1e9)), a.length / 2) + 1;
  std::vector<double> curve;
  for (int lag = -most; lag <= most; ++lag) curve.push_back(correlation(a, b, lag).value_or(-1));

  std::vector<std::size_t> tops;
  for (std::size_t i = 1; i + 1 < curve.size(); ++i)
    if (curve[i] > weakest && curve[i] >= curve[i - 1] && curve[i] > curve[i + 1]) tops.push_back(i);
  if (tops.empty()) return std::nullopt;
  double highest = 0;
  for (const std::size_t i : tops) highest = std::max(highest, curve[i]);
  double best = std::numeric_limits<double>::infinity();
  for (const std::size_t i : tops) {
    const double lag = static_cast<double>(i) - most + parabola_top(curve[i - 1], curve[i], curve[i + 1]);
    if (curve[i] > highest - equal && std::abs(lag) < std::abs(best)) best = lag;
  }
  if (!(std::abs(best) * geometry.cell() <= max_shift)) return std::nullopt;
  return best * geometry.cell();
}

}  // namespace aeolian
