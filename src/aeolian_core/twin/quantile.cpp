#include "aeolian_core/twin/quantile.hpp"

namespace aeolian {
namespace {

double value_of_rank(std::vector<double>& sample, double rank) {
  const auto last = static_cast<double>(sample.size() - 1);
  const auto at = sample.begin() + static_cast<std::ptrdiff_t>(std::clamp(rank, 0.0, last));
  std::nth_element(sample.begin(), at, sample.end());
  return *at;
}

}  // namespace

double value_at_place(std::vector<double>& sample, double place) {
  const auto below = sample.begin() + static_cast<std::ptrdiff_t>(place);
  std::nth_element(sample.begin(), below, sample.end());
  const double fraction = place - std::floor(place);
  if (fraction == 0) return *below;  // also keeps an infinite value from becoming NaN
  const double above = *std::min_element(below + 1, sample.end());
  return *below == above ? above : *below + fraction * (above - *below);
}

double quantile(std::vector<double>& sample, double share) {
  if (sample.empty()) return NAN;
  return value_at_place(sample, share * static_cast<double>(sample.size() - 1));
}

Bracket likely_bracket(std::vector<double>& probe, double share) {
  const auto count = static_cast<double>(probe.size());
  const double margin = 4 * std::sqrt(count * share * (1 - share)) + 4;
  const double low = value_of_rank(probe, share * count - margin);
  return {low, value_of_rank(probe, share * count + margin)};
}

}  // namespace aeolian
