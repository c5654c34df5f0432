#pragma once

#include <algorithm>
#include <future>
#include <thread>
#include <vector>

namespace aeolian {

/// The results of `run(member)` for members 0 to `count` - 1 of an ensemble whose members know nothing of
/// each other, in order, by as many threads as the machine has cores. What a member throws is thrown again.
template <class Run>
auto run_members(int count, const Run& run) -> std::vector<decltype(run(0))> {
  std::vector<decltype(run(0))> results(static_cast<std::size_t>(count));
  const int threads =
      std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, std::max(1, count));
  std::vector<std::future<void>> workers;
  workers.reserve(static_cast<std::size_t>(threads));
  for (int first = 0; first < threads; ++first)
    workers.push_back(std::async(std::launch::async, [&, first] {
      for (int member = first; member < count; member += threads)
        results[static_cast<std::size_t>(member)] = run(member);
    }));
  for (std::future<void>& worker : workers) worker.get();
  return results;
}

}  // namespace aeolian
