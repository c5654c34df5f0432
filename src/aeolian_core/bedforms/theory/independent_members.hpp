#pragma once

#include <cstddef>
#include <vector>

#include <tbb/parallel_for.h>

namespace aeolian {

/// The results of `run(member)` for members 0 to `count` - 1 of an ensemble whose members know nothing of
/// each other, in order, by as many threads as oneTBB has. What a member throws is thrown again.
template <class Run>
auto run_members(int count, const Run& run) -> std::vector<decltype(run(0))> {
  std::vector<decltype(run(0))> results(static_cast<std::size_t>(count));
  tbb::parallel_for(0, count, [&](int member) { results[static_cast<std::size_t>(member)] = run(member); });
  return results;
}

}  // namespace aeolian
