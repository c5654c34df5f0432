#include "aeolian_core/measure/profile_shift.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "aeolian_core/measure/parabola.hpp"
#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Two profiles at the same places.
struct Pair {
  std::vector<double> earlier;
  std::vector<double> later;
  double step = 0;
};

double height_at(const EvenProfile& profile, double x) {
  const double at = std::max(0.0, (x - profile.start) / profile.step);
  const std::size_t k = std::min(static_cast<std::size_t>(at), profile.z.size() - 2);
  const double share = std::min(1.0, at - static_cast<double>(k));
  return profile.z[k] + share * (profile.z[k + 1] - profile.z[k]);
}

double end_of(const EvenProfile& profile) {
  return profile.start + profile.step * static_cast<double>(profile.z.size() - 1);
}

Pair common_section(const EvenProfile& earlier, const EvenProfile& later) {
  const double from = std::max(earlier.start, later.start);
  const double to = std::min(end_of(earlier), end_of(later));
  Pair pair;
  pair.step = std::max(earlier.step, later.step);
  EvenProfile mean{from, pair.step, {}, {}};
  for (double i = 0; from + i * pair.step <= to; ++i) {
    pair.earlier.push_back(height_at(earlier, from + i * pair.step));
    pair.later.push_back(height_at(later, from + i * pair.step));
    mean.z.push_back(0.5 * (pair.earlier.back() + pair.later.back()));
  }
  constexpr std::size_t fewest = 8;
  if (mean.z.size() < fewest)
    throw Error("profile series: sections " + std::to_string(earlier.start) + " to " +
                std::to_string(end_of(earlier)) + " m and " + std::to_string(later.start) + " to " +
                std::to_string(end_of(later)) + " m do not overlap");
  const std::vector<double> level = detrended(mean);
  for (std::size_t i = 0; i < level.size(); ++i) {
    pair.earlier[i] -= mean.z[i] - level[i];
    pair.later[i] -= mean.z[i] - level[i];
  }
  return pair;
}

struct Sums {
  double n = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
};

Sums sums_at(const Pair& pair, long lag) {
  const auto n = static_cast<long>(pair.earlier.size());
  Sums s;
  for (long i = std::max(0L, -lag); i < std::min(n, n - lag); ++i) {
    const double a = pair.earlier[static_cast<std::size_t>(i)];
    const double b = pair.later[static_cast<std::size_t>(i + lag)];
    ++s.n;
    s.a += a;
    s.b += b;
    s.aa += a * a;
    s.bb += b * b;
    s.ab += a * b;
  }
  return s;
}

/// Correlation coefficient of earlier(i) with later(i + lag); -1 where one does not vary.
double correlation_at(const Pair& pair, long lag) {
  const Sums s = sums_at(pair, lag);
  const double product = (s.aa - s.a * s.a / s.n) * (s.bb - s.b * s.b / s.n);
  return product > 0 ? (s.ab - s.a * s.b / s.n) / std::sqrt(product) : -1;
}

/// Standard error of the shift [m]: sum of slope times difference over the sum of squared slopes, the
/// differences taken as one where they may be correlated.
double shift_error(const Pair& pair, double lag, std::size_t stretch) {
  const auto whole = static_cast<long>(std::floor(lag));
  const double share = lag - static_cast<double>(whole);
  const auto n = static_cast<long>(pair.earlier.size());
  const Sums s = sums_at(pair, std::lround(lag));
  const double gain = (s.ab - s.a * s.b / s.n) / (s.aa - s.a * s.a / s.n);  // growth is no noise
  const double offset = (s.b - gain * s.a) / s.n;
  double slopes = 0;
  double variance = 0;
  double stretch_sum = 0;
  std::size_t in_stretch = 0;
  for (long i = std::max(1L, -whole); i < std::min(n - 1, n - whole - 1); ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto moved = static_cast<std::size_t>(i + whole);
    const double slope = (pair.earlier[at + 1] - pair.earlier[at - 1]) / (2 * pair.step);
    const double later = (1 - share) * pair.later[moved] + share * pair.later[moved + 1];
    stretch_sum += slope * (later - gain * pair.earlier[at] - offset);
    slopes += gain * slope * slope;
    if (++in_stretch == stretch) {
      variance += stretch_sum * stretch_sum;
      stretch_sum = 0;
      in_stretch = 0;
    }
  }
  variance += stretch_sum * stretch_sum;
  return std::sqrt(variance) / slopes;
}

}  // namespace

std::optional<ProfileShift> profile_shift(const EvenProfile& earlier, const EvenProfile& later,
                                          double expected, double range) {
  constexpr double weakest = 0.3;
  const Pair pair = common_section(earlier, later);
  const auto n = static_cast<double>(pair.earlier.size());
  // A quarter of the section must be left to compare.
  const double furthest = 0.75 * n;
  const auto first =
      static_cast<long>(std::ceil(std::clamp((expected - range) / pair.step, -furthest, furthest)));
  const auto last =
      static_cast<long>(std::floor(std::clamp((expected + range) / pair.step, -furthest, furthest)));
  std::vector<double> curve;
  for (long lag = first; lag <= last; ++lag) curve.push_back(correlation_at(pair, lag));
  if (curve.size() < 3) return std::nullopt;
  const auto top = static_cast<std::size_t>(std::max_element(curve.begin(), curve.end()) - curve.begin());
  if (top == 0 || top + 1 == curve.size() || curve[top] < weakest) return std::nullopt;

  // A parabola over a twentieth of the wavelength to each side, or what there is.
  const std::size_t half = std::clamp<std::size_t>(static_cast<std::size_t>(range / (10 * pair.step)), 1,
                                                   std::min(top, curve.size() - 1 - top));
  const auto vertex = parabola_vertex(curve, top - half, top + half);
  if (!vertex) return std::nullopt;
  const double lag = static_cast<double>(first) + vertex->position;
  const auto stretch = std::max<std::size_t>(1, static_cast<std::size_t>(range / (2 * pair.step)));
  return ProfileShift{{lag * pair.step, shift_error(pair, lag, stretch)}, curve[top]};
}

}  // namespace aeolian
