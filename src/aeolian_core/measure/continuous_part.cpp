#include "aeolian_core/measure/continuous_part.hpp"

#include <algorithm>
#include <cmath>

namespace aeolian {
namespace {

constexpr std::size_t least_run = 8;

struct Run {
  std::size_t begin = 0;  // into the list of known points
  std::size_t end = 0;
};

}  // namespace

std::vector<bool> continuous_part(const std::vector<double>& x, const std::vector<double>& y, double steepest,
                                  double slack) {
  std::vector<std::size_t> known;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (!std::isnan(x[i]) && !std::isnan(y[i])) known.push_back(i);
  std::vector<bool> part(x.size(), false);
  if (known.empty()) return part;
  const auto reachable = [&](std::size_t a, std::size_t b) {
    return std::abs(y[b] - y[a]) <= steepest * std::abs(x[b] - x[a]) + slack;
  };
  std::vector<Run> runs{{0, 1}};
  for (std::size_t k = 1; k < known.size(); ++k) {
    if (reachable(known[k - 1], known[k]))
      runs.back().end = k + 1;
    else
      runs.push_back({k, k + 1});
  }
  const auto longest = std::max_element(
      runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.end - a.begin < b.end - b.begin; });
  const auto keep = [&](const Run& run) {
    for (std::size_t k = run.begin; k < run.end; ++k) part[known[k]] = true;
  };
  keep(*longest);
  std::size_t last = known[longest->end - 1];
  for (auto run = longest + 1; run != runs.end(); ++run)
    if (run->end - run->begin >= least_run && reachable(last, known[run->begin])) {
      keep(*run);
      last = known[run->end - 1];
    }
  std::size_t first = known[longest->begin];
  for (auto run = longest; run-- != runs.begin();)
    if (run->end - run->begin >= least_run && reachable(first, known[run->end - 1])) {
      keep(*run);
      first = known[run->begin];
    }
  return part;
}

}  // namespace aeolian
