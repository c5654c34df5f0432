#include "aeolian_core/twin/line_scales.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "aeolian_core/measure/length_scales.hpp"
#include "aeolian_core/measure/parabola.hpp"

namespace aeolian {
namespace {

constexpr std::size_t most_lines = 24;
constexpr std::size_t groups = 8;

/// The first maximum after the first minimum of a smooth curve, in its samples.
std::optional<double> first_maximum(const std::vector<double>& f) {
  constexpr double turn = 0.05;
  double lowest = INFINITY;
  std::size_t top = 0;
  for (std::size_t i = 0; i < f.size(); ++i) {
    lowest = std::min(lowest, f[i]);
    if (top == 0 && f[i] > lowest + turn) top = i;
    if (top == 0) continue;
    if (f[i] > f[top]) top = i;
    if (f[i] > f[top] - turn) continue;
    const std::size_t half = std::max<std::size_t>(1, top / 25);
    if (const auto vertex = parabola_vertex(f, top - half, std::min(top + half, f.size() - 1)))
      return vertex->position;
    return static_cast<double>(top);
  }
  return std::nullopt;
}

/// Where a line is known longest without a gap: first sample and number.
std::pair<std::size_t, std::size_t> longest_stretch(const float* known, int length) {
  std::size_t first = 0;
  std::size_t most = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(length); ++i) {
    count = known[i] != 0 ? count + 1 : 0;
    if (count <= most) continue;
    most = count;
    first = i + 1 - count;
  }
  return {first, most};
}

std::vector<std::vector<double>> stretches(const DirectionalLines& lines, std::size_t shortest) {
  std::vector<std::vector<double>> all;
  for (int line = 0; line < lines.count; ++line) {
    const auto [first, samples] = longest_stretch(lines.known.data() + lines.start(line), lines.length);
    if (samples < shortest) continue;
    const float* value = lines.value.data() + lines.start(line) + first;
    all.emplace_back(value, value + samples);
  }
  const std::size_t stride = (all.size() + most_lines - 1) / most_lines;
  std::vector<std::vector<double>> result;
  for (std::size_t i = 0; i < all.size(); i += stride) result.push_back(std::move(all[i]));
  return result;
}

}  // namespace

LineScales line_scales(const DirectionalLines& lines, double cell, std::size_t lags, double alike) {
  LineScales result;
  result.dominant = {NAN, NAN};
  const std::vector<std::vector<double>> heights = stretches(lines, 2 * lags);
  if (heights.empty() || !(alike > 0)) return result;
  std::vector<std::vector<double>> of_group(std::min(groups, heights.size()));
  std::vector<double> sum;
  for (std::size_t line = 0; line < heights.size(); ++line) {
    const std::vector<double> f = LengthScales(heights[line], alike).distribution(lags);
    std::vector<double>& group = of_group[line * of_group.size() / heights.size()];
    group.resize(f.size());
    sum.resize(f.size());
    for (std::size_t i = 0; i < f.size(); ++i) {
      group[i] += f[i];
      sum[i] += f[i];
    }
  }
  const auto lines_used = static_cast<double>(heights.size());
  for (std::size_t i = 0; i < sum.size(); ++i) {
    result.lag.push_back(static_cast<double>(i + 1) * cell);
    result.distribution.push_back(sum[i] / lines_used);
  }
  const auto dominant = first_maximum(result.distribution);
  if (!dominant) return result;
  result.dominant.value = (*dominant + 1) * cell;
  if (of_group.size() < groups) return result;
  double mean = 0;
  double squares = 0;
  for (std::size_t g = 0; g < groups; ++g) {
    std::size_t left_out = 0;
    for (std::size_t line = 0; line < heights.size(); ++line)
      left_out += line * groups / heights.size() == g ? 1 : 0;
    std::vector<double> rest;
    for (std::size_t i = 0; i < sum.size(); ++i)
      rest.push_back((sum[i] - of_group[g][i]) / (lines_used - static_cast<double>(left_out)));
    const double off = first_maximum(rest).value_or(NAN) - *dominant;
    mean += off / groups;
    squares += off * off;
  }
  const double variance = (groups - 1.0) / groups * (squares - groups * mean * mean);
  result.dominant.sigma = std::sqrt(std::max(0.0, variance)) * cell;
  return result;
}

}  // namespace aeolian
