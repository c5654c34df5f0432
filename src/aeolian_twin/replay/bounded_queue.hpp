#pragma once

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <utility>

namespace aeolian {

/// Hands things from one thread to another in their order; a giver that is too far ahead waits.
template <class Thing>
class BoundedQueue {
 public:
  explicit BoundedQueue(std::size_t most) : most_(most) {}

  /// False, and the thing is lost, once the queue has been closed.
  bool push(Thing thing) {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || things_.size() < most_; });
    if (closed_) return false;
    things_.push_back(std::move(thing));
    changed_.notify_all();
    return true;
  }
  /// The next one; nothing when the queue is closed and empty.
  std::optional<Thing> pop() {
    std::unique_lock<std::mutex> lock(mutex_);
    changed_.wait(lock, [this] { return closed_ || !things_.empty(); });
    if (things_.empty()) return std::nullopt;
    std::optional<Thing> first = std::move(things_.front());
    things_.pop_front();
    changed_.notify_all();
    return first;
  }
  /// Nothing more is to come, or to be taken.
  void close() {
    const std::lock_guard<std::mutex> lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }

 private:
  std::size_t most_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Thing> things_;
  bool closed_ = false;
};

}  // namespace aeolian
