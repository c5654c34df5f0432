#pragma once

#include <exception>
#include <functional>
#include <string>
#include <thread>
#include <utility>

#include <boost/shared_ptr.hpp>
#include <rosbag/bag.h>

#include "aeolian_twin/replay/bounded_queue.hpp"

namespace aeolian {

/// Messages into a bag, serialised and compressed in a thread of its own, in the order in which they are
/// given.
class TwinBag {
 public:
  /// `bag` must outlive this, and be left alone meanwhile.
  explicit TwinBag(rosbag::Bag& bag);
  TwinBag(const TwinBag&) = delete;
  TwinBag& operator=(const TwinBag&) = delete;
  ~TwinBag();

  template <class Message>
  void write(const std::string& topic, const ros::Time& time, boost::shared_ptr<const Message> message) {
    waiting_.push([this, topic, time, message = std::move(message)] { bag_.write(topic, time, *message); });
  }
  /// Waits until all is written. Throws what went wrong; nothing has been written since then.
  void finish();

 private:
  void work();

  rosbag::Bag& bag_;
  BoundedQueue<std::function<void()>> waiting_;
  std::exception_ptr failure_;  ///< read when the writer has ended
  std::thread writer_;
};

}  // namespace aeolian
