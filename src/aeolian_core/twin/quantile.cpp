#include "aeolian_core/twin/quantile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "aeolian_core/measure/kernel.hpp"

namespace aeolian {
namespace {

constexpr std::size_t probes = 16384;
constexpr std::size_t block = 16;

/// What is ranked: values about a centre, or how far they lie from it.
struct Ranked {
  double centre;
  double folding;  ///< 1: the sign counts, -1: it does not

  double operator()(float value) const {
    const double v = static_cast<double>(value) - centre;
    return v > folding * v ? v : folding * v;
  }
};

double value_of_rank(std::vector<double>& sample, double rank) {
  const auto last = static_cast<double>(sample.size() - 1);
  const auto at = sample.begin() + static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, last));
  std::nth_element(sample.begin(), at, sample.end());
  return *at;
}

/// The value at a place (from 0) between the ranks of a sample, which is reordered.
double value_at_place(std::vector<double>& sample, double place) {
  const auto below = sample.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(sample.begin(), below, sample.end());
  const double fraction = place - std::floor(place);
  if (fraction == 0) return *below;  // also keeps an infinite value from becoming NaN
  const double above = *std::min_element(below + 1, sample.end());
  return *below == above ? above : *below + fraction * (above - *below);
}

/// Two values that most likely enclose the quantile of what a probe (reordered) was taken from.
struct Bracket {
  double low, high;
};
Bracket likely_bracket(std::vector<double>& probe, double share) {
  const auto count = static_cast<double>(probe.size());
  const double margin = 4 * std::sqrt(count * share * (1 - share)) + 4;
  const double low = value_of_rank(probe, share * count - margin);
  return {low, value_of_rank(probe, share * count + margin)};
}

struct Counts {
  std::int32_t below = 0;
  std::int32_t between = 0;
};

AEOLIAN_KERNEL Counts count(const float* values, Ranked ranked, Bracket bracket) {
  Counts counts;
  for (std::size_t i = 0; i < block; ++i) {
    const double v = ranked(values[i]);
    counts.below += v < bracket.low ? 1 : 0;
    counts.between += (v >= bracket.low) & (v <= bracket.high) ? 1 : 0;
  }
  return counts;
}

double quantile_of(const std::vector<float>& values, std::size_t known, double share, Ranked ranked) {
  std::vector<double> sample;
  const auto take = [&](float value) {
    if (!std::isnan(value)) sample.push_back(ranked(value));
  };
  const bool large = known > 4 * probes;
  if (large)
    for (std::size_t i = 0; i < probes; ++i) take(values[i * values.size() / probes]);
  if (large && !sample.empty()) {
    const Bracket bracket = likely_bracket(sample, share);
    std::vector<double> between;
    std::size_t below = 0;
    const auto take_between = [&](const float* from) {
      const Counts counts = count(from, ranked, bracket);
      below += static_cast<std::size_t>(counts.below);
      if (counts.between == 0) return;
      for (std::size_t i = 0; i < block; ++i) {
        const double v = ranked(from[i]);
        if (v >= bracket.low && v <= bracket.high) between.push_back(v);
      }
    };
    const std::size_t whole = values.size() / block * block;
    for (std::size_t i = 0; i < whole; i += block) take_between(&values[i]);
    std::array<float, block> rest;
    rest.fill(NAN);
    std::copy(values.begin() + static_cast<std::ptrdiff_t>(whole), values.end(), rest.begin());
    take_between(rest.data());
    const double place = share * static_cast<double>(known - 1) - static_cast<double>(below);
    if (place >= 0 && std::floor(place) + 1 < static_cast<double>(between.size()))
      return value_at_place(between, place);
  }
  sample.clear();
  for (const float value : values) take(value);
  return quantile(sample, share);
}

}  // namespace

double quantile(std::vector<double>& sample, double share) {
  if (sample.empty()) return NAN;
  return value_at_place(sample, share * static_cast<double>(sample.size() - 1));
}

double quantile_of(const std::vector<float>& values, std::size_t known, double share) {
  return quantile_of(values, known, share, Ranked{0, 1});
}

double quantile_of_distances(const std::vector<float>& values, std::size_t known, double share,
                             double centre) {
  return quantile_of(values, known, share, Ranked{centre, -1});
}

}  // namespace aeolian
