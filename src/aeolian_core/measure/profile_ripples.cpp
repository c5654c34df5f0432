#include "aeolian_core/measure/profile_ripples.hpp"

#include <algorithm>
#include <cmath>

#include "aeolian_core/measure/parabola.hpp"

namespace aeolian {
namespace {

struct Point {
  double at = 0;  ///< [samples]
  double z = 0;   ///< [m]
};

struct Edge {
  std::size_t left;
  std::size_t right;
};

/// The edge of the lower convex hull of samples first..last that spans the crest.
std::optional<Edge> spanning_edge(const std::vector<double>& z, std::size_t first, std::size_t crest,
                                  std::size_t last) {
  std::vector<std::size_t> hull;
  for (std::size_t i = first; i <= last; ++i) {
    while (hull.size() >= 2) {
      const std::size_t a = hull[hull.size() - 2];
      const std::size_t b = hull.back();
      const double turn =
          (z[b] - z[a]) * static_cast<double>(i - a) - (z[i] - z[a]) * static_cast<double>(b - a);
      if (turn < 0) break;
      hull.pop_back();
    }
    hull.push_back(i);
  }
  const auto right = std::lower_bound(hull.begin(), hull.end(), crest);
  if (right == hull.begin() || right == hull.end() || *right == crest) return std::nullopt;
  return Edge{*(right - 1), *right};
}

/// The bottom of the trough about sample i of heights over a tangent: the vertex of the cubic through all
/// that noise may have made deeper, the sample itself where that says nothing.
Point bottom(const std::vector<double>& over, std::size_t i, std::size_t first, std::size_t last,
             double noise) {
  std::size_t left = i;
  std::size_t right = i;
  while (left > first && over[left - 1] <= 3 * noise) --left;
  while (right < last && over[right + 1] <= 3 * noise) ++right;
  const auto vertex = right - left >= 4 ? cubic_vertex(over, left, right) : std::nullopt;
  if (!vertex || vertex->curvature <= 0) return {static_cast<double>(i), over[i]};
  return {vertex->position, vertex->value};
}

std::vector<double> over_line(const std::vector<double>& z, const Point& a, const Point& b) {
  std::vector<double> over(z.size());
  const double rise = (b.z - a.z) / (b.at - a.at);
  for (std::size_t i = 0; i < z.size(); ++i) over[i] = z[i] - a.z - rise * (static_cast<double>(i) - a.at);
  return over;
}

/// Slopes of least-squares lines over `width` samples from each sample of a flank on, as dz per sample: the
/// steepest after `sign`. A flank shorter than that is taken whole.
double steepest(const std::vector<double>& z, double from, double to, std::size_t width, double sign) {
  const auto first = static_cast<std::size_t>(std::ceil(from - 1e-9));
  const auto last = static_cast<std::size_t>(std::floor(to + 1e-9));
  if (last < first + 1) return 0;
  const std::size_t n = std::min(width, last - first + 1);
  const double middle = 0.5 * static_cast<double>(n - 1);
  double sum = 0;
  double moment = 0;
  for (std::size_t k = 0; k < n; ++k) {
    sum += z[first + k];
    moment += (static_cast<double>(k) - middle) * z[first + k];
  }
  double best = sign * moment;
  for (std::size_t i = first + 1; i + n <= last + 1; ++i) {
    // One step on, every sample but the first comes one place nearer to the beginning.
    moment += (middle + 1) * z[i - 1] - sum + middle * z[i + n - 1];
    sum += z[i + n - 1] - z[i - 1];
    best = std::max(best, sign * moment);
  }
  const auto count = static_cast<double>(n);
  return best / (count * (count * count - 1) / 12);
}

}  // namespace

std::vector<std::size_t> prominent_crests(const std::vector<double>& curve, double prominence) {
  std::vector<std::size_t> crests;
  if (curve.empty()) return crests;
  bool rising = false;
  std::size_t top = 0;
  double lowest = curve.front();
  for (std::size_t i = 1; i < curve.size(); ++i) {
    if (rising) {
      if (curve[i] > curve[top]) top = i;
      if (curve[i] >= curve[top] - prominence) continue;
      crests.push_back(top);
      rising = false;
      lowest = curve[i];
    } else {
      lowest = std::min(lowest, curve[i]);
      if (curve[i] <= lowest + prominence) continue;
      rising = true;
      top = i;
    }
  }
  return crests;
}

std::optional<RippleShape> measure_ripple(const std::vector<double>& z, double step, std::size_t first,
                                          std::size_t crest, std::size_t last, double noise) {
  const auto edge = spanning_edge(z, first, crest, last);
  if (!edge) return std::nullopt;
  // The part of the profile that matters, so that all below is local.
  const std::vector<double> part(z.begin() + static_cast<std::ptrdiff_t>(first),
                                 z.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  const std::size_t left = edge->left - first;
  const std::size_t right = edge->right - first;
  const Point touch_left{static_cast<double>(left), part[left]};
  const Point touch_right{static_cast<double>(right), part[right]};
  const std::vector<double> rough = over_line(part, touch_left, touch_right);
  // However noisy, a trough or a crest is no more than half of the ripple's height.
  const double doubt = std::min(noise, rough[crest - first] / 6);
  const Point low_left = bottom(rough, left, 0, crest - first, doubt);
  const Point low_right = bottom(rough, right, crest - first, part.size() - 1, doubt);
  const double rise = (touch_right.z - touch_left.z) / (touch_right.at - touch_left.at);
  const auto on_bed = [&](const Point& p) {
    return Point{p.at, p.z + touch_left.z + rise * (p.at - touch_left.at)};
  };
  const Point start = on_bed(low_left);
  const Point end = on_bed(low_right);
  if (!(end.at > start.at)) return std::nullopt;

  std::vector<double> under = over_line(part, start, end);
  const auto inside = [&](double at) { return under.begin() + static_cast<std::ptrdiff_t>(at); };
  const auto top = static_cast<std::size_t>(
      std::max_element(inside(std::ceil(start.at)), inside(std::floor(end.at)) + 1) - under.begin());
  RippleShape shape;
  shape.left_rise = *std::max_element(under.begin(), inside(start.at) + 1);
  shape.right_rise = *std::max_element(inside(std::ceil(end.at)), under.end());
  const double highest = under[top];
  for (double& height : under) height = highest - height;
  const Point peak = bottom(under, top, static_cast<std::size_t>(std::ceil(start.at)),
                            static_cast<std::size_t>(end.at), doubt);
  const double over_tangent = highest - peak.z;
  if (!(over_tangent > 0 && peak.at > start.at && peak.at < end.at)) return std::nullopt;

  const double slope = (end.z - start.z) / ((end.at - start.at) * step);
  const double angle = std::atan(slope);
  shape.start = static_cast<double>(first) + start.at;
  shape.crest = static_cast<double>(first) + peak.at;
  shape.end = static_cast<double>(first) + end.at;
  shape.tangent_slope = angle;
  shape.wavelength = (end.at - start.at) * step / std::cos(angle);
  shape.height = over_tangent * std::cos(angle);
  const double to_crest = (peak.at - start.at) * step / std::cos(angle) + over_tangent * std::sin(angle);
  shape.left_mean = std::atan2(shape.height, to_crest);
  shape.right_mean = std::atan2(shape.height, shape.wavelength - to_crest);
  const auto width = std::max<std::size_t>(
      2, static_cast<std::size_t>(std::lround(shape.wavelength * std::cos(angle) / (10 * step))) + 1);
  shape.left_max = std::atan(steepest(part, start.at, peak.at, width, 1) / step) - angle;
  shape.right_max = std::atan(steepest(part, peak.at, end.at, width, -1) / step) + angle;
  return shape;
}

}  // namespace aeolian
