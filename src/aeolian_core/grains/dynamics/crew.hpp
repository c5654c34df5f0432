#pragma once

#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace aeolian {

/// So many threads that share the pieces of a piece of work. Copies share the threads.
class Crew {
 public:
  /// Zero: as many as the machine has.
  void set_threads(int threads) {
    constexpr int all = tbb::task_arena::automatic;
    arena_ = threads == 1 ? nullptr : std::make_shared<tbb::task_arena>(threads > 0 ? threads : all);
  }

  /// Calls work(piece) for all from zero to `pieces`.
  template <class Work>
  void share(int pieces, Work work) const {
    if (!arena_ || pieces < 2) {
      for (int piece = 0; piece < pieces; ++piece) work(piece);
      return;
    }
    arena_->execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<int>(0, pieces),
          [&](const tbb::blocked_range<int>& range) {
            for (int piece = range.begin(); piece < range.end(); ++piece) work(piece);
          },
          tbb::static_partitioner());
    });
  }

 private:
  std::shared_ptr<tbb::task_arena> arena_;
};

}  // namespace aeolian
