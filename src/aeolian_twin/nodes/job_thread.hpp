#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace aeolian {

/// Does one job after another on a thread of its own. One job may wait; a newer one takes its place.
template <typename Job>
class JobThread {
 public:
  /// Does nothing before start().
  JobThread() = default;
  JobThread(const JobThread&) = delete;
  JobThread& operator=(const JobThread&) = delete;
  /// Waits for the job under way, not for the one that waits.
  ~JobThread() { stop(); }

  /// `work` is called with each job and must not throw.
  void start(std::function<void(const Job&)> work) {
    thread_ = std::thread([this, work = std::move(work)] { do_jobs(work); });
  }
  void stop() {
    stopping_ = true;
    { const std::lock_guard<std::mutex> lock(mutex_); }
    wake_.notify_one();
    if (thread_.joinable()) thread_.join();
  }
  /// For long jobs, that they may end early.
  bool stopping() const { return stopping_; }

  /// False when the job has to wait for the one under way.
  bool submit(Job job) {
    const std::lock_guard<std::mutex> lock(mutex_);
    next_ = std::move(job);
    wake_.notify_one();
    return !working_;
  }
  bool idle() const {
    const std::lock_guard<std::mutex> lock(mutex_);
    return !working_ && !next_;
  }

 private:
  void do_jobs(const std::function<void(const Job&)>& work) {
    std::unique_lock<std::mutex> lock(mutex_);
    while (true) {
      wake_.wait(lock, [this] { return stopping_ || next_; });
      if (stopping_) return;
      const Job job = std::move(*next_);
      next_.reset();
      working_ = true;
      lock.unlock();
      work(job);
      lock.lock();
      working_ = false;
    }
  }

  mutable std::mutex mutex_;  ///< guards next_ and working_
  std::condition_variable wake_;
  std::optional<Job> next_;
  bool working_ = false;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace aeolian
