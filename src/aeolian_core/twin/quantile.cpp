#include "aeolian_core/twin/quantile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr std::size_t probes = 16384;
constexpr std::size_t block = 2048;

/// What is ranked: values about a centre, or how far they lie from it.
struct Ranked {
  double centre;
  double folding;  ///< 1: the sign counts, -1: it does not

  double operator()(float value) const {
    const double v = static_cast<double>(value) - centre;
    return v > folding * v ? v : folding * v;
  }
};

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
  const auto at_rank = [&](double rank) {
    return probe.begin() + static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, count - 1));
  };
  const auto low = at_rank(share * count - margin);
  const auto high = at_rank(share * count + margin);
  std::nth_element(probe.begin(), low, probe.end());
  const double least = *low;
  std::nth_element(low, high, probe.end());
  return {least, *high};
}

/// Floats between which lies, whatever the rounding, what a bracket holds.
struct Sieve {
  Sieve(const Ranked& ranked, const Bracket& bracket)
      : centre(static_cast<float>(ranked.centre)),
        folding(static_cast<float>(ranked.folding)),
        low(static_cast<float>(bracket.low - margin(ranked, bracket))),
        high(static_cast<float>(bracket.high + margin(ranked, bracket))) {}
  static double margin(const Ranked& ranked, const Bracket& bracket) {
    return 1e-6 * (std::abs(ranked.centre) + std::max(std::abs(bracket.low), std::abs(bracket.high)));
  }

  float centre, folding, low, high;
};

/// Counts what lies below the sieve and marks what it holds: 1, else 0.
AEOLIAN_KERNEL std::int32_t sift(const float* __restrict values, Sieve sieve, std::uint8_t* __restrict held) {
  std::int32_t below[block];
  for (std::size_t i = 0; i < block; ++i) {
    const float v = values[i] - sieve.centre;
    const float folded = v > sieve.folding * v ? v : sieve.folding * v;
    below[i] = folded < sieve.low ? 1 : 0;
    const std::int32_t in = (folded >= sieve.low) & (folded <= sieve.high) ? 1 : 0;
    held[i] = static_cast<std::uint8_t>(in);
  }
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < block; ++i) sum += below[i];
  return sum;
}

/// How many of a block's values lie below the bracket; those within are added to `between`.
std::size_t take_between(const float* values, const Ranked& ranked, const Bracket& bracket,
                         std::vector<double>& between) {
  std::array<std::uint8_t, block> held;
  std::array<double, block + 1> kept;
  auto below = static_cast<std::size_t>(sift(values, Sieve(ranked, bracket), held.data()));
  std::size_t count = 0;
  for (std::size_t at = 0; at < block; at += sizeof(std::uint64_t)) {
    std::uint64_t any;
    std::memcpy(&any, &held[at], sizeof any);
    if (any == 0) continue;
    for (std::size_t i = at; i < at + sizeof any; ++i) {  // without a branch that could be guessed wrong
      const double v = ranked(values[i]);
      kept[count] = v;
      below += static_cast<std::size_t>(held[i]) & static_cast<std::size_t>(v < bracket.low);
      count += static_cast<std::size_t>(v >= bracket.low) & static_cast<std::size_t>(v <= bracket.high);
    }
  }
  between.insert(between.end(), kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count));
  return below;
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
    const std::size_t whole = values.size() / block * block;
    for (std::size_t i = 0; i < whole; i += block)
      below += take_between(&values[i], ranked, bracket, between);
    std::array<float, block> rest;
    rest.fill(NAN);
    std::copy(values.begin() + static_cast<std::ptrdiff_t>(whole), values.end(), rest.begin());
    below += take_between(rest.data(), ranked, bracket, between);
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
