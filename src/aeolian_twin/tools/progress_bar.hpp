#pragma once

#include <chrono>
#include <cmath>
#include <cstdio>
#include <string>

#include <fmt/format.h>
#include <unistd.h>

namespace aeolian {

/// How far a long task is and how long it will still take, on a terminal; says nothing to a file.
class ProgressBar {
 public:
  ProgressBar() : begin_(Clock::now()), shown_(isatty(STDERR_FILENO) != 0) {}
  ~ProgressBar() { clear(); }
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// `share` is what is done of the whole, 0 to 1; a smaller one than before begins a new task.
  void at(double share, const std::string& task) {
    if (!shown_) return;
    const auto now = Clock::now();
    if (share < share_) begin_ = now;
    share_ = share;
    if (share < 1 && now - shown_at_ < std::chrono::milliseconds(100)) return;
    shown_at_ = now;
    constexpr int width = 30;
    const auto full = static_cast<std::size_t>(std::lround(share * width));
    const double spent = std::chrono::duration<double>(now - begin_).count();
    const std::string left = share > 0 ? remaining(spent * (1 - share) / share) + " left" : "";
    fmt::print(stderr, "\r[{}{}] {:3.0f} %  {}  {}\033[K", std::string(full, '#'),
               std::string(width - full, '.'), 100 * share, task, left);
    std::fflush(stderr);
  }

  /// Takes it off the terminal.
  void clear() const {
    if (shown_) std::fputs("\r\033[K", stderr);
  }

 private:
  using Clock = std::chrono::steady_clock;

  static std::string remaining(double seconds) {
    const auto s = static_cast<long>(std::ceil(seconds));
    if (s < 60) return fmt::format("{} s", s);
    if (s < 3600) return fmt::format("{}:{:02} min", s / 60, s % 60);
    return fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
  }

  Clock::time_point begin_;
  Clock::time_point shown_at_;
  double share_ = 0;
  bool shown_;
};

}  // namespace aeolian
