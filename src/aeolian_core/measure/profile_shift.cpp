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
  double x = from;
  while (x <= to) {
    pair.earlier.push_back(height_at(earlier, x));
    pair.later.push_back(height_at(later, x));
    x = from + pair.step * static_cast<double>(pair.earlier.size());
  }
  constexpr std::size_t fewest = 8;
  if (pair.earlier.size() < fewest)
    throw Error("profile series: sections " + std::to_string(earlier.start) + " to " +
                std::to_string(end_of(earlier)) + " m and " + std::to_string(later.start) + " to " +
                std::to_string(end_of(later)) + " m do not overlap");
  return pair;
}

/// later(i + lag) = offset + tilt (i - middle) + gain earlier(i) by least squares over all i that both have.
struct Match {
  long first = 0;
  long end = 0;
  double middle = 0;
  double offset = 0;
  double tilt = 0;
  double gain = 0;
  double correlation = -1;  ///< of the two without their lines; -1 where one is a line
};

Match match_at(const Pair& pair, long lag) {
  const auto count = static_cast<long>(pair.earlier.size());
  Match m;
  m.first = std::max(0L, -lag);
  m.end = std::min(count, count - lag);
  m.middle = 0.5 * static_cast<double>(m.first + m.end - 1);
  double a = 0;
  double b = 0;
  double aa = 0;
  double bb = 0;
  double ab = 0;
  double au = 0;
  double bu = 0;
  for (long i = m.first; i < m.end; ++i) {
    const double u = static_cast<double>(i) - m.middle;
    const double za = pair.earlier[static_cast<std::size_t>(i)];
    const double zb = pair.later[static_cast<std::size_t>(i + lag)];
    a += za;
    b += zb;
    aa += za * za;
    bb += zb * zb;
    ab += za * zb;
    au += za * u;
    bu += zb * u;
  }
  const auto n = static_cast<double>(m.end - m.first);
  const double uu = n * (n * n - 1) / 12;
  const double va = aa - a * a / n - au * au / uu;
  const double vb = bb - b * b / n - bu * bu / uu;
  const double vab = ab - a * b / n - au * bu / uu;
  if (va * vb > 0) m.correlation = vab / std::sqrt(va * vb);
  m.gain = vab / va;
  m.offset = (b - m.gain * a) / n;
  m.tilt = (bu - m.gain * au) / uu;
  return m;
}

/// Slope of the earlier profile by least squares over `half` samples to each side: between neighbours it
/// would be that of the noise.
double slope_at(const Pair& pair, long i, long half) {
  double moment = 0;
  for (long k = -half; k <= half; ++k)
    moment += static_cast<double>(k) * pair.earlier[static_cast<std::size_t>(i + k)];
  const auto h = static_cast<double>(half);
  return moment / (h * (h + 1) * (2 * h + 1) / 3 * pair.step);
}

/// Standard error of the shift [m]: sum of slope times difference over the sum of squared slopes, the
/// differences taken as one where they may be correlated.
double shift_error(const Pair& pair, double lag, std::size_t stretch) {
  const long half = std::max(1L, static_cast<long>(stretch / 5));
  const auto whole = static_cast<long>(std::floor(lag));
  const double share = lag - static_cast<double>(whole);
  const Match m = match_at(pair, std::lround(lag));
  double slopes = 0;
  double variance = 0;
  double stretch_sum = 0;
  std::size_t in_stretch = 0;
  double stretches = 0;
  for (long i = m.first + half; i + half + 1 < m.end; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const auto moved = static_cast<std::size_t>(i + whole);
    const double slope = m.gain * slope_at(pair, i, half);
    const double later = (1 - share) * pair.later[moved] + share * pair.later[moved + 1];
    const double expected =
        m.offset + m.tilt * (static_cast<double>(i) - m.middle) + m.gain * pair.earlier[at];
    stretch_sum += slope * (later - expected);
    slopes += slope * slope;
    if (++in_stretch == stretch) {
      variance += stretch_sum * stretch_sum;
      stretch_sum = 0;
      in_stretch = 0;
      ++stretches;
    }
  }
  variance += stretch_sum * stretch_sum;
  // Shift, gain and the line's two parameters have been fitted to the differences.
  constexpr double fitted = 4;
  const double lost = std::max(stretches, fitted + 1) / std::max(stretches - fitted, 1.0);
  return std::sqrt(variance * lost) / slopes;
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
  for (long lag = first; lag <= last; ++lag) curve.push_back(match_at(pair, lag).correlation);
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
