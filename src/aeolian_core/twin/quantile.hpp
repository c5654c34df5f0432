#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace aeolian {

/// The value below which a share of the sample lies, linear between order statistics (0 least, 0.5 median, 1
/// greatest). The sample is reordered. NaN when it is empty; it must hold no NaN.
double quantile(std::vector<double>& sample, double share);

/// The value at a place (from 0) between the ranks of a sample, which is reordered.
double value_at_place(std::vector<double>& sample, double place);

/// Two values of a sample of many that most likely enclose its quantile; `probe` is a thousandth or more of
/// it, which is reordered.
struct Bracket {
  double low, high;
};
Bracket likely_bracket(std::vector<double>& probe, double share);

/// quantile() of value(i), i < count, of which exactly `known` are not NaN, without storing them: a probe
/// tells between which values the quantile most likely lies, one pass counts what is below and keeps the few
/// between.
template <class Value>
double quantile_of(std::size_t count, std::size_t known, double share, Value&& value) {
  constexpr std::size_t probes = 16384;
  std::vector<double> sample;
  const auto take = [&](std::size_t i) {
    if (const double v = value(i); !std::isnan(v)) sample.push_back(v);
  };
  const bool large = known > 4 * probes;
  if (large) {
    for (std::size_t i = 0; i < probes; ++i) take(i * count / probes);
  }
  if (large && !sample.empty()) {
    const Bracket bracket = likely_bracket(sample, share);
    std::vector<double> between(known / 8);
    const std::size_t room = between.size() - 1;
    std::size_t kept = 0;
    std::size_t below = 0;
    for (std::size_t i = 0; i < count; ++i) {  // without a branch that the processor could guess wrong
      const double v = value(i);
      between[kept] = v;
      kept += static_cast<std::size_t>(v >= bracket.low) & static_cast<std::size_t>(v <= bracket.high) &
              static_cast<std::size_t>(kept < room);
      below += static_cast<std::size_t>(v < bracket.low);
    }
    between.resize(kept);
    const double place = share * static_cast<double>(known - 1) - static_cast<double>(below);
    if (kept < room && place >= 0 && std::floor(place) + 1 < static_cast<double>(kept))
      return value_at_place(between, place);
  }
  sample.clear();
  for (std::size_t i = 0; i < count; ++i) take(i);
  return quantile(sample, share);
}

}  // namespace aeolian
