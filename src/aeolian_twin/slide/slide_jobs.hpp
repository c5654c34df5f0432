#pragma once

#include <atomic>
#include <fstream>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "aeolian_core/slide/piles/slide_series.hpp"
#include "aeolian_twin/ranks/ranks.hpp"

namespace aeolian {

/// A series of events to run in two or three dimensions.
struct SlideJob {
  SlideScene scene;
  int events = 1;
  int dimensions = 2;
};

/// Its piles, one after each event. There are fewer than events where `ended` tells why: a slab was stuck.
struct SlideOutcome {
  std::vector<PileSize> piles;
  std::string ended;
};

/// Outcomes of jobs as they are done, in a file beside the results until all have been written, so that the
/// same command goes on from there, whatever has ended it. Jobs are told apart by the numbers of their
/// scenes.
class SlideJournal {
 public:
  /// Reads what the processes of a study have left in FOLDER/unfinished*.csv, or begins anew when `fresh`.
  /// `settings` are lines that decide the jobs. Throws Error naming the file where it is of other settings or
  /// holds what no study has written, but for a last line that was cut short.
  SlideJournal(const std::string& folder, const std::string& settings, bool fresh, const Ranks& ranks);

  /// Nothing when it is still to do.
  const SlideOutcome* find(const SlideJob& job) const;
  std::size_t count() const { return done_.size(); }
  /// Throws Error where the file cannot be written.
  void add(const SlideJob& job, const SlideOutcome& outcome);
  /// Removes the files of all processes: the results are written. For one process to call.
  void finish();

  std::string lines_of(const std::vector<SlideJob>& jobs) const;  ///< of those that are done
  void take(const std::string& lines, const std::string& from);   ///< what lines_of has given elsewhere

 private:
  std::string path_;
  std::map<std::string, SlideOutcome> done_;
  std::ofstream file_;
};

/// How jobs are spread and watched.
struct SlideWork {
  SlideJournal& journal;
  const Ranks& ranks;
  int threads = 0;  ///< of this process, each with a job of its own; 0: all
  const std::atomic<bool>& stop;
  /// Is told what this process has done of its share, by one thread at a time.
  std::function<void(std::size_t done, std::size_t all)> progress;
};

/// Runs the jobs that the journal does not hold: each process of `ranks` its share, each thread one at a
/// time. Outcomes are those of the jobs, in every process; nothing for those that were stopped. They do not
/// depend on threads and processes.
std::vector<std::optional<SlideOutcome>> run_jobs(const std::vector<SlideJob>& jobs, const SlideWork& work);

}  // namespace aeolian
