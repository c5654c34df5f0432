#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include <boost/shared_ptr.hpp>

namespace aeolian {

/// Makes the messages into which a subscriber reads what comes over the net; the memory of those that nobody
/// holds any more serves for the next. Large ones are otherwise cleared and handed back to the system each
/// time. What a copy makes and what the original makes is kept together; safe from any thread.
template <class Message>
class MessagePool {
 public:
  boost::shared_ptr<Message> operator()() const {
    std::unique_ptr<Message> message = kept_->take();
    if (!message) message = std::make_unique<Message>();
    return {message.release(), [kept = kept_](Message* done) { kept->put(std::unique_ptr<Message>(done)); }};
  }

 private:
  class Kept {
   public:
    std::unique_ptr<Message> take() {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (messages_.empty()) return nullptr;
      std::unique_ptr<Message> message = std::move(messages_.back());
      messages_.pop_back();
      return message;
    }
    void put(std::unique_ptr<Message> message) {
      constexpr std::size_t most = 2;  // one is worked on while the next comes
      const std::lock_guard<std::mutex> lock(mutex_);
      if (messages_.size() < most) messages_.push_back(std::move(message));
    }

   private:
    std::mutex mutex_;
    std::vector<std::unique_ptr<Message>> messages_;
  };

  std::shared_ptr<Kept> kept_ = std::make_shared<Kept>();
};

}  // namespace aeolian
