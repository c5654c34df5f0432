#pragma once

#include <chrono>
#include <string>

namespace aeolian {

/// How far a long task is and how long it will still take, on a terminal; says nothing to a file.
class ProgressBar {
 public:
  ProgressBar();
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share` is what is done of the whole, 0 to 1; a smaller one than before begins a new task.
  void at(double share, const std::string& task);

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_;
  Clock::time_point shown_at_;
  double share_ = 0;
  bool shown_;
};

}  // namespace aeolian
