#include "aeolian_core/twin/line_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace aeolian {
namespace {

constexpr std::size_t parts = 8;

/// Sums for a line fit of residuals over slopes.
struct Sums {
  double n = 0, g = 0, r = 0, gg = 0, gr = 0;

  void add(double slope, double residual) {
    n += 1;
    g += slope;
    r += residual;
    gg += slope * slope;
    gr += slope * residual;
  }
  void add(const Sums& other, double sign) {
    n += sign * other.n;
    g += sign * other.g;
    r += sign * other.r;
    gg += sign * other.gg;
    gr += sign * other.gr;
  }
  /// By how much the lag must grow.
  double step() const { return -(gr - g * r / n) / (gg - g * g / n); }
};

std::array<Sums, parts> sums_at(const DirectionalLines& a, const DirectionalLines& b, double lag) {
  std::array<Sums, parts> result;
  const int whole = static_cast<int>(std::floor(lag));
  const float share = static_cast<float>(lag - whole);
  const int first = std::max(1, 1 - whole);
  const int last = std::min(a.length - 1, a.length - 2 - whole);
  for (int line = 0; line < a.count; ++line) {
    const float* va = &a.value[a.start(line)];
    const float* ka = &a.known[a.start(line)];
    const float* vb = &b.value[b.start(line)];
    const float* kb = &b.known[b.start(line)];
    for (int x = first; x < last; ++x) {
      const int at = x + whole;
      if (ka[x - 1] * ka[x] * ka[x + 1] * kb[at - 1] * kb[at] * kb[at + 1] * kb[at + 2] == 0) continue;
      const float residual = vb[at] + share * (vb[at + 1] - vb[at]) - va[x];
      const float low = vb[at + 1] - vb[at - 1];
      const float high = vb[at + 2] - vb[at];
      const float slope = 0.25F * (va[x + 1] - va[x - 1] + low + share * (high - low));
      const auto part = static_cast<std::size_t>(a.count >= 16 ? line : x) * parts /
                        static_cast<std::size_t>(a.count >= 16 ? a.count : a.length);
      result[part].add(static_cast<double>(slope), static_cast<double>(residual));
    }
  }
  return result;
}

}  // namespace

Figure match_lines(const DirectionalLines& earlier, const DirectionalLines& later, double lag) {
  constexpr int steps = 4;
  Figure result{lag, NAN};
  std::array<Sums, parts> of_part;
  Sums all;
  for (int i = 0; i < steps; ++i) {
    of_part = sums_at(earlier, later, result.value);
    all = {};
    for (const Sums& part : of_part) all.add(part, 1);
    result.value += std::clamp(all.step(), -1.0, 1.0);
  }
  double sum = 0;
  double squares = 0;
  for (const Sums& part : of_part) {
    Sums rest = all;
    rest.add(part, -1);
    const double off = rest.step() - all.step();
    sum += off;
    squares += off * off;
  }
  result.sigma = std::sqrt(std::max(0.0, (parts - 1.0) / parts * (squares - sum * sum / parts)));
  return result;
}

}  // namespace aeolian
