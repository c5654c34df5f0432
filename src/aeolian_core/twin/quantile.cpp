#include "aeolian_core/twin/quantile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "aeolian_core/surface/kernel.hpp"

namespace aeolian {
namespace {

constexpr std::size_t probes = 16384;
constexpr std::size_t few_probes = 1024;
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

/// Two values, or ranks (from 0), that enclose what is looked for.
struct Bracket {
  double low, high;
};

/// Ranks of a probe that, with odds of 16000 to 1, enclose what a share of all lies below.
Bracket likely_ranks(std::size_t probe, double low_share, double high_share) {
  const auto count = static_cast<double>(probe);
  const auto margin = [&](double share) { return 4 * std::sqrt(count * share * (1 - share)) + 4; };
  return {std::clamp(low_share * count - margin(low_share), 0.0, count - 1),
          std::clamp(high_share * count + margin(high_share), 0.0, count - 1)};
}

/// The values at two ranks of a sample, which is reordered.
Bracket values_at(std::vector<double>& sample, Bracket ranks) {
  const auto low = sample.begin() + static_cast<std::ptrdiff_t>(ranks.low);
  const auto high = sample.begin() + static_cast<std::ptrdiff_t>(ranks.high);
  std::nth_element(sample.begin(), low, sample.end());
  const double least = *low;
  std::nth_element(low, high, sample.end());
  return {least, *high};
}

/// Leaves of a large sample little more than what lies between two ranks; how many lay below that. The idea
/// of Floyd & Rivest (1975, Commun. ACM 18, 165-172): some of the sample tell what is worth to be sorted.
std::size_t narrow(std::vector<double>& sample, Bracket ranks) {
  if (sample.size() < 4 * few_probes) return 0;
  std::vector<double> probe(few_probes);
  for (std::size_t i = 0; i < few_probes; ++i) probe[i] = sample[i * sample.size() / few_probes];
  const auto count = static_cast<double>(sample.size());
  const Bracket bracket = values_at(probe, likely_ranks(few_probes, ranks.low / count, ranks.high / count));
  std::vector<double> kept(sample.size());
  std::size_t below = 0;
  std::size_t between = 0;
  for (const double value : sample) {  // without a branch that could be guessed wrong
    kept[between] = value;
    below += value < bracket.low ? 1 : 0;
    between += (value >= bracket.low) & (value <= bracket.high) ? 1 : 0;
  }
  if (static_cast<double>(below) > ranks.low || ranks.high >= static_cast<double>(below + between)) return 0;
  kept.resize(between);
  sample = std::move(kept);
  return below;
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

/// Two values that most likely enclose the quantile of what a probe was taken from; little is left of it.
Bracket likely_bracket(std::vector<double>& probe, double share) {
  const Bracket ranks = likely_ranks(probe.size(), share, share);
  const auto gone = static_cast<double>(narrow(probe, ranks));
  return values_at(probe, {ranks.low - gone, ranks.high - gone});
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
  std::int32_t below = 0;
  for (std::size_t i = 0; i < block; ++i) {
    const float v = values[i] - sieve.centre;
    const float folded = v > sieve.folding * v ? v : sieve.folding * v;
    below += folded < sieve.low ? 1 : 0;
    held[i] = (folded >= sieve.low) & (folded <= sieve.high) ? 1 : 0;
  }
  return below;
}

/// How many of a block's values lie below the sieve; those that it holds are added to `between`.
std::size_t take_between(const float* values, const Sieve& sieve, std::vector<float>& between) {
  std::array<std::uint8_t, block> held;
  std::array<float, block + 1> kept;
  const auto below = static_cast<std::size_t>(sift(values, sieve, held.data()));
  std::size_t count = 0;
  for (std::size_t at = 0; at < block; at += sizeof(std::uint64_t)) {
    std::uint64_t any;
    std::memcpy(&any, &held[at], sizeof any);
    if (any == 0) continue;
    for (std::size_t i = at; i < at + sizeof any; ++i) {  // without a branch that could be guessed wrong
      kept[count] = values[i];
      count += held[i];
    }
  }
  between.insert(between.end(), kept.begin(), kept.begin() + static_cast<std::ptrdiff_t>(count));
  return below;
}

/// The same of all values, which need not fill their last block.
std::size_t take_between(const std::vector<float>& values, const Sieve& sieve, std::vector<float>& between) {
  std::size_t below = 0;
  const std::size_t whole = values.size() / block * block;
  for (std::size_t i = 0; i < whole; i += block) below += take_between(&values[i], sieve, between);
  std::array<float, block> rest;
  rest.fill(NAN);
  std::copy(values.begin() + static_cast<std::ptrdiff_t>(whole), values.end(), rest.begin());
  return below + take_between(rest.data(), sieve, between);
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
    std::vector<float> held;
    std::size_t below = take_between(values, Sieve(ranked, bracket), held);
    std::vector<double> between;
    between.reserve(held.size());
    for (const float value : held) {
      const double v = ranked(value);
      if (v >= bracket.low && v <= bracket.high) between.push_back(v);
      below += v < bracket.low ? 1 : 0;
    }
    const double place = share * static_cast<double>(known - 1) - static_cast<double>(below);
    const Bracket ranks{std::floor(place), std::floor(place) + 1};
    if (ranks.low >= 0 && ranks.high < static_cast<double>(between.size())) {
      const std::size_t gone = narrow(between, ranks);
      return value_at_place(between, place - static_cast<double>(gone));
    }
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
  return std::abs(quantile_of(values, known, share, Ranked{centre, -1}));  // no zero with a sign
}

}  // namespace aeolian
