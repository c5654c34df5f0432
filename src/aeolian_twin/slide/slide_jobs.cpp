#include "aeolian_twin/slide/slide_jobs.hpp"

#include <mutex>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "aeolian_core/surface/error.hpp"

namespace aeolian {
namespace {

/// Nothing when it was stopped.
template <int Dim>
std::optional<SlideOutcome> run_job(const SlideJob& job, const std::atomic<bool>& stop) {
  SlideScene scene = job.scene;
  scene.threads = 1;
  SlideSeries<Dim> series(scene);
  SlideOutcome outcome;
  try {
    for (int k = 0; k < job.events; ++k) {
      const auto event = series.next([&](const SlideMoment<Dim>&) { return !stop; });
      if (!event) return std::nullopt;
      outcome.piles.push_back(event->pile);
    }
  } catch (const Error& error) {
    outcome.ended = error.what();
  }
  return outcome;
}

}  // namespace

std::vector<std::optional<SlideOutcome>> run_jobs(const std::vector<SlideJob>& jobs, const SlideWork& work) {
  for (const SlideJob& job : jobs) check(job.scene, job.dimensions);
  std::vector<std::size_t> open;
  std::size_t own = 0;
  for (std::size_t k = work.ranks.rank(); k < jobs.size(); k += work.ranks.count(), ++own)
    if (work.journal.find(jobs[k]) == nullptr) open.push_back(k);
  std::mutex one_at_a_time;
  std::size_t left = open.size();
  const auto tell = [&] {
    if (work.progress) work.progress(own - left, own);
  };
  tell();
  tbb::task_arena arena(work.threads > 0 ? work.threads : tbb::task_arena::automatic);
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, open.size(), 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t k = range.begin(); k < range.end() && !work.stop; ++k) {
            const SlideJob& job = jobs[open[k]];
            const auto outcome =
                job.dimensions == 2 ? run_job<2>(job, work.stop) : run_job<3>(job, work.stop);
            if (!outcome) return;
            const std::lock_guard<std::mutex> lock(one_at_a_time);
            work.journal.add(job, *outcome);
            --left;
            tell();
          }
        },
        tbb::simple_partitioner());
  });
  const auto all = work.ranks.share(work.journal.lines_of(jobs));
  for (std::size_t rank = 0; rank < all.size(); ++rank)
    if (rank != work.ranks.rank()) work.journal.take(all[rank], "another process");
  std::vector<std::optional<SlideOutcome>> outcomes;
  for (const SlideJob& job : jobs) {
    const SlideOutcome* found = work.journal.find(job);
    outcomes.push_back(found != nullptr ? std::make_optional(*found) : std::nullopt);
  }
  return outcomes;
}

}  // namespace aeolian
